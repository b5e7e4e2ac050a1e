"""The model of the knee: mesh, materials, load and contacts."""

from __future__ import annotations

from dataclasses import dataclass, replace

from harness.models.document import Model
from harness.models.header import header
from harness.models.interface import ContactSettings, InterfaceType, automatic, contacts
from harness.models.knee import anatomy, bearing, whole_mesh
from harness.models.knee.bearing import Load, Loading
from harness.models.knee.tissues import Bodies, materials
from harness.models.knee.whole_mesh import Size
from harness.models.parts import GAS_CONSTANT, TEMPERATURE, UNCLAMPED, Param

MEDIAL_SHARE = 0.6
"""Part of the load that the medial compartment bears in the mean of published knees: the load acts so far medially."""
CONCENTRATION = 1.0
"""Effective concentration of the solute in the synovial fluid at last, mM."""
SOLID_FRACTION = 0.1
"""phi of the friction law between porous bodies."""
HELD = 100.0
"""s; elastic bodies are not held, because nothing changes in them."""
FEBIO_FACTOR = 10.0
"""Of FEBio's automatic penalty: 1 leaves bodies overlapping, and 1000, with which other models here are run, inverts
elements in the first step."""
ABOUT = """\
A knee: two condyles on a tibial plateau, with menisci between them. {bodies} cartilage on rigid bone, and {bodies}
menisci with fibres along their arcs, whose horns springs hold to the tibia. {load}
Shapes, materials and loads are published or simplified from published ones: scripts/harness/models/knee."""
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
    bodies : Bodies
    load : Load
    friction : float
        Coefficient mu_eq in all contacts.
    settings : ContactSettings, optional
        Of all contacts; `settings_of` without it.
    name : str
    """

    contact: InterfaceType = InterfaceType.MIXTURE
    size: Size = Size.SMALL
    bodies: Bodies = Bodies.ELASTIC
    load: Load = Load.STANCE
    friction: float = 0.0
    settings: ContactSettings | None = None
    name: str = "knee"

    def model(self) -> Model:
        """The model of these choices."""
        made, horns = whole_mesh.meshed(self.size)
        loading = self._loading()
        given = self.settings or settings_of(self.contact, self.bodies)
        given = replace(given, extra=(*given.extra, *self._rubbing(), *self._outside()))
        about = ABOUT.format(bodies=self.bodies.value.capitalize(), load=ABOUT_LOADS[self.load])
        return Model(
            self.name,
            header(self.name, about, self.contact),
            self.bodies.module,
            made,
            materials(self.bodies, self._axis()),
            loading.conditions(),
            loading.control(UNCLAMPED.solver if self.bodies is Bodies.SOLUTE else ()),
            contacts(self.contact, made, given),
            loading.curves,
            plot=True,
            springs=horns,
            node_log=False,
        )

    def _axis(self) -> tuple[float, float, float]:
        """Where the force acts: on the axis of flexion."""
        medial, lateral = (side.centre for side in anatomy.COMPARTMENTS)
        across = MEDIAL_SHARE * medial + (1.0 - MEDIAL_SHARE) * lateral
        return across, 0.0, anatomy.SAGITTAL - whole_mesh.DIVISIONS[self.size].seat

    def _loading(self) -> Loading:
        if self.load is Load.GAIT:
            return bearing.gait()
        return bearing.stance(bearing.RISE if self.bodies is Bodies.ELASTIC else HELD)

    def _rubbing(self) -> tuple[Param, ...]:
        if self.friction == 0.0:
            return ()
        porous = () if self.bodies is Bodies.ELASTIC else (Param("contact_frac", SOLID_FRACTION),)
        return (Param("fric_coeff", self.friction), *porous)

    def _outside(self) -> tuple[Param, ...]:
        """Ambient values: the solute comes with the synovial fluid, whose fluid pressure is 0."""
        if self.bodies is not Bodies.SOLUTE:
            return ()
        osmotic = -GAS_CONSTANT * TEMPERATURE * CONCENTRATION
        dissolved = Param("ambient_concentration", CONCENTRATION, bearing.FLUID, {"sol": "1"})
        return (Param("ambient_pressure", osmotic, bearing.FLUID), dissolved)


def settings_of(contact: InterfaceType, bodies: Bodies) -> ContactSettings:
    """The plugin's default settings, or FEBio's automatic penalties times `FEBIO_FACTOR`."""
    if contact is InterfaceType.MIXTURE:
        return ContactSettings()
    given = automatic(FEBIO_FACTOR)
    if bodies is not Bodies.SOLUTE:
        given = replace(given, concentration_penalty=None)
    return replace(given, pressure_penalty=None) if bodies is Bodies.ELASTIC else given
