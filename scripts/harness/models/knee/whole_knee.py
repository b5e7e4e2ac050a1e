"""The model of the knee: mesh, materials, load and contacts."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from harness.models.document import Model
from harness.models.interface import ContactSettings, InterfaceType, contacts, header
from harness.models.knee import anatomy, bearing, whole_mesh
from harness.models.knee.bearing import Load
from harness.models.knee.tissues import TISSUES, Bodies, Tissues
from harness.models.knee.whole_mesh import FEMORAL, FEMUR, MENISCAL, TIBIA, TIBIAL, Size
from harness.models.parts import Material, Param, Rigid


def materials(tissues: Tissues, centre: tuple[float, float, float]) -> Mapping[str, Material]:
    """Materials by name; forces on the femur act at `centre`, about which it turns, mm."""
    cartilage, meniscus = tissues.cartilage, tissues.meniscus
    return {FEMORAL: cartilage, TIBIAL: cartilage, MENISCAL: meniscus, FEMUR: Rigid(centre), TIBIA: Rigid()}


MEDIAL_SHARE = 0.6
"""Part of the load that the medial compartment bears in the mean of published knees: the load acts so far medially."""
FEBIO_FACTOR = 10.0
"""Of FEBio's automatic penalty: 1 leaves bodies overlapping, and 1000, with which other models here are run, inverts
elements in the first step."""
ABOUT = """\
A knee: two condyles press on a tibial plateau, with menisci between them. {tissues} {load}
Shapes, materials and loads are published, or simplified from published ones. The sources are in
scripts/harness/models/knee."""


@dataclass(frozen=True)
class Knee:
    """Choices of the knee."""

    contact: InterfaceType = InterfaceType.MIXTURE
    size: Size = Size.SMALL
    load: Load = Load.STANCE
    friction: float = 0.0  # coefficient mu_eq in all contacts
    settings: ContactSettings | None = None  # of all contacts; `settings_of` without it
    name: str = "knee"
    bodies: Bodies = Bodies.ELASTIC  # kind of cartilage and menisci

    def model(self) -> Model:
        """The model of these choices."""
        tissues = TISSUES[self.bodies]
        made = whole_mesh.meshed(self.size, porous=tissues.porous)
        medial, lateral = (side.centre for side in anatomy.COMPARTMENTS)
        loading = bearing.porous(self.load) if tissues.porous else bearing.loading(self.load)
        stands = tuple(replace(stand, curve=len(loading.curves)) for stand in made.stands if loading.softening)
        given = self.settings or settings_of(self.contact, tissues)
        friction = (Param("fric_coeff", self.friction),) if self.friction else ()
        given = replace(given, extra=(*given.extra, *tissues.ambient, *friction))
        return Model(
            self.name,
            header(self.name, ABOUT.format(tissues=tissues.about, load=loading.about), self.contact),
            tissues.module,
            made.mesh,
            materials(tissues, (MEDIAL_SHARE * medial + (1.0 - MEDIAL_SHARE) * lateral, 0.0, made.axis)),
            (*loading.conditions(), *tissues.conditions),
            loading.control(),
            contacts(self.contact, made.mesh, given),
            loading.curves,
            plot=True,
            springs=(*made.horns, *stands),
            node_log=False,
            further_plot=("contact force",),
        )


def settings_of(contact: InterfaceType, tissues: Tissues) -> ContactSettings:
    """The plugin's default settings, or FEBio's automatic penalties times `FEBIO_FACTOR`."""
    return ContactSettings() if contact.needs_plugin else tissues.automatic(FEBIO_FACTOR)
