"""The model of the knee: mesh, materials, load and contacts.

Sources
-------
Haut Donahue, Hull, Rashid and Jacobs (2002), J Biomech Eng 124:273: cartilage 15 MPa and 0.475, menisci 150 MPa around
and 20 MPa across.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from harness.models.document import Model
from harness.models.interface import ContactSettings, InterfaceType, automatic, contacts, header
from harness.models.knee import anatomy, bearing, whole_mesh
from harness.models.knee.bearing import Load
from harness.models.knee.whole_mesh import FEMORAL, FEMUR, MENISCAL, TIBIA, TIBIAL, Size
from harness.models.parts import Elastic, Element, Material, Param, Rigid, Solid, child

TOE = 1.01
"""Stretch at which all fibres are straight."""


@dataclass(frozen=True)
class Fibrous(Solid):
    """Neo-Hookean matrix with fibres along the first edges of the elements, which bear tension alone.

    Attributes
    ----------
    fibres : float
        Young's modulus that straight fibres add along themselves, MPa.
    """

    fibres: float = 0.0

    def write(self, parent: Element, tag: str = "solid") -> Element:
        """Append the solid to `parent` under the name `tag`."""
        made = child(parent, tag, type="solid mixture")
        super().write(made)
        fibres = child(made, "solid", type="fiber-pow-linear")
        child(fibres, "E", self.fibres)
        child(fibres, "lam0", TOE)
        child(fibres, "beta", 2.0)
        child(fibres, "fiber", (1, 2), type="local")
        return made


CARTILAGE, MENISCUS = Elastic(Solid(15.0, 0.475)), Elastic(Fibrous(20.0, 0.3, fibres=130.0))


def materials(centre: tuple[float, float, float]) -> Mapping[str, Material]:
    """Materials by name; forces on the femur act at `centre`, about which it turns, mm."""
    return {FEMORAL: CARTILAGE, TIBIAL: CARTILAGE, MENISCAL: MENISCUS, FEMUR: Rigid(centre), TIBIA: Rigid()}


MEDIAL_SHARE = 0.6
"""Part of the load that the medial compartment bears in the mean of published knees: the load acts so far medially."""
FEBIO_FACTOR = 10.0
"""Of FEBio's automatic penalty: 1 leaves bodies overlapping, and 1000, with which other models here are run, inverts
elements in the first step."""
ABOUT = """\
A knee: two condyles press on a tibial plateau, with menisci between them. Elastic cartilage covers rigid bone. The
elastic menisci contain fibres along their arcs, and springs connect their horns to the tibia. {load}
Shapes, materials and loads are published, or simplified from published ones. The sources are in
scripts/harness/models/knee."""
ABOUT_LOADS = {
    Load.STANCE: "A force of 700 N presses the femur down.",
    Load.GAIT: "Force and flexion go through one cycle of gait in 1 s.",
}


@dataclass(frozen=True)
class Knee:
    """Choices of the knee.

    Attributes
    ----------
    contact : InterfaceType
    size : Size
    load : Load
    friction : float
        Coefficient mu_eq in all contacts.
    settings : ContactSettings, optional
        Of all contacts; `settings_of` without it.
    name : str
    """

    contact: InterfaceType = InterfaceType.MIXTURE
    size: Size = Size.SMALL
    load: Load = Load.STANCE
    friction: float = 0.0
    settings: ContactSettings | None = None
    name: str = "knee"

    def model(self) -> Model:
        """The model of these choices."""
        made, horns = whole_mesh.meshed(self.size)
        loading = bearing.gait() if self.load is Load.GAIT else bearing.stance()
        given = self.settings or settings_of(self.contact)
        if self.friction:
            given = replace(given, extra=(*given.extra, Param("fric_coeff", self.friction)))
        return Model(
            self.name,
            header(self.name, ABOUT.format(load=ABOUT_LOADS[self.load]), self.contact),
            "solid",
            made,
            materials(self._axis()),
            loading.conditions(),
            loading.control(),
            contacts(self.contact, made, given),
            loading.curves,
            plot=True,
            springs=horns,
            node_log=False,
            further_plot=("contact force",),
        )

    def _axis(self) -> tuple[float, float, float]:
        """Where the force acts: on the axis of flexion."""
        medial, lateral = (side.centre for side in anatomy.COMPARTMENTS)
        across = MEDIAL_SHARE * medial + (1.0 - MEDIAL_SHARE) * lateral
        return across, 0.0, anatomy.SAGITTAL - whole_mesh.DIVISIONS[self.size].seat


def settings_of(contact: InterfaceType) -> ContactSettings:
    """The plugin's default settings, or FEBio's automatic penalties times `FEBIO_FACTOR`."""
    if contact is InterfaceType.MIXTURE:
        return ContactSettings()
    return replace(automatic(FEBIO_FACTOR), pressure_penalty=None, concentration_penalty=None)
