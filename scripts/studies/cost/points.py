"""The points of the sweep: a problem, an interface, and one parameter away from the defaults."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from enum import Enum

from harness.models import indentation
from harness.models.convection import Convection
from harness.models.diffusion import Diffusion
from harness.models.document import Model
from harness.models.indentation import Indentation
from harness.models.indentation_mesh import Grid
from harness.models.interface import ContactSettings, InterfaceType, automatic, default_settings
from harness.models.parts import Control, Curve, Param
from studies.models.kept_models import LEVELS

INTERFACES = (InterfaceType.MIXTURE, InterfaceType.SOLUTE, InterfaceType.MULTIPHASIC)
HALFWAY = Grid(across=13, down=9, around=4)
"""A mesh of problem 3.3 between the coarse one and the medium one, which its reference has."""
END_33 = 100.0  # s up to which problem 3.3 is run: first touch, the moving edge of contact, and the first diffusion
TIMES_33 = (1.0, END_33)
ELEMENTS, STEPS = 5, 20
"""Through each cube of 3.1 (to 2000 s) and 3.2 (to 20000 s), and number of time steps, unless these are varied."""
AUGLAG_START = 10.0  # factor of the automatic penalties from which the augmentations start


class Problem(str, Enum):
    """The article's problems."""

    DIFFUSION = "3.1"
    CONVECTION = "3.2"
    INDENTATION = "3.3"


class Parameter(str, Enum):
    """What is varied; the value of `integration` and of `LAGMULT` is 1 for segments, 0 for Gauss points."""

    DEFAULT = "default"
    MESH = "elements"
    STEP = "steps"
    ORDER = "integration_order"
    INTEGRATION = "integration"
    PENALTY = "penalty factor"
    AUGLAG = "AUGLAG tolerance"
    LAGMULT = "LAGMULT"
    PREDICTOR = "predictor"
    NEWTON = "Newton tolerance"


OWN = (Parameter.ORDER, Parameter.INTEGRATION, Parameter.LAGMULT, Parameter.PREDICTOR)
"""Of the plugin's interface alone."""
VALUES: dict[Parameter, tuple[float, ...]] = {
    Parameter.DEFAULT: (0.0,),
    Parameter.MESH: (3, 10, 20),
    Parameter.STEP: (10, 40, 80),
    Parameter.ORDER: (1, 3, 5),
    Parameter.INTEGRATION: (0,),
    Parameter.PENALTY: tuple(10.0**k for k in range(7)),
    Parameter.AUGLAG: tuple(10.0**-k for k in range(1, 8)),
    Parameter.LAGMULT: (0, 1),
    Parameter.PREDICTOR: (1,),
    Parameter.NEWTON: (1e-1, 1e-3, 1e-6),
}
VALUES_33: dict[Parameter, tuple[float, ...]] = {
    Parameter.DEFAULT: (0.0,),
    Parameter.MESH: (13,),
    Parameter.STEP: (0.5, 2.0),
    Parameter.ORDER: (3,),
    Parameter.INTEGRATION: (0,),
    Parameter.PENALTY: (1.0, 10.0, 100.0, 1000.0),
    Parameter.AUGLAG: (1e-1, 1e-2),
    Parameter.LAGMULT: (0, 1),
    Parameter.PREDICTOR: (1,),
    Parameter.NEWTON: (1e-2, 1e-4),
}
"""Of problem 3.3: elements over the half-width of the slab (else 9), and a factor on the number of steps."""


@dataclass(frozen=True)
class Point:
    """One run of the sweep."""

    problem: Problem
    interface: InterfaceType
    parameter: Parameter
    value: float

    @property
    def name(self) -> str:
        """Part of file names."""
        parameter = self.parameter.value.replace(" ", "-")
        return f"{self.problem.value}-{self.interface.slug}-{parameter}-{self.value:g}"

    @property
    def settings(self) -> ContactSettings:
        """Parameters of the contact."""
        base = default_settings(self.interface)
        if self.parameter is Parameter.PENALTY:
            return automatic(self.value)
        if self.parameter is Parameter.AUGLAG:
            return replace(automatic(AUGLAG_START), laugon="AUGLAG", tolerance=self.value)
        if self.parameter is Parameter.ORDER:
            return replace(base, extra=(Param("integration_order", int(self.value)),))
        if self.parameter is Parameter.PREDICTOR:
            return replace(base, extra=(Param("predictor", bool(self.value)),))
        if self.parameter in (Parameter.INTEGRATION, Parameter.LAGMULT):
            laugon = "LAGMULT" if self.parameter is Parameter.LAGMULT else None
            return replace(base, laugon=laugon, integration="segments" if self.value else "gauss")
        return base

    def model(self, interface: InterfaceType | None = None) -> Model:
        """The model; with `interface` joined otherwise, all else being the same."""
        return _BUILDERS[self.problem](self, interface or self.interface)

    def _control(self, control: Control) -> Control:
        if self.parameter is not Parameter.NEWTON:
            return control
        return replace(
            control,
            displacement_tolerance=self.value,
            pressure_tolerance=self.value,
            concentration_tolerance=self.value,
        )

    def _steps(self, end: float) -> Control:
        steps = int(self.value) if self.parameter is Parameter.STEP else STEPS
        return self._control(Control(steps, end / steps))

    @property
    def _elements(self) -> int:
        return int(self.value) if self.parameter is Parameter.MESH else ELEMENTS


def _cubes(scene: Diffusion | Convection, end: float) -> Callable[[Point, InterfaceType], Model]:
    """Builds two cubes of a scene up to `end` (s)."""

    def build(point: Point, interface: InterfaceType) -> Model:
        return replace(
            scene,
            interface=interface,
            settings=point.settings if interface.is_contact else None,
            elements=point._elements,
            control=point._steps(end),
            module=point.interface.module,
            name=f"cost-{point.name}-{interface.slug}",
        ).model()

    return build


def _indentation(point: Point, interface: InterfaceType) -> Model:
    control = replace(indentation.CONTROL, steps=round(END_33 / indentation.CONTROL.step))
    model = Indentation(
        interface,
        point.settings,
        grid=HALFWAY if point.parameter is Parameter.MESH else LEVELS[0],
        control=point._control(control),
        name=f"cost-{point.name}",
    ).model()
    factor = point.value if point.parameter is Parameter.STEP else 1.0
    return in_more_steps(model, factor)


def in_more_steps(model: Model, factor: float) -> Model:
    """Problem 3.3 with its largest time steps divided by `factor`."""
    ramp, steps = model.curves
    shorter = Curve(tuple((time, step / factor) for time, step in steps.points))
    return replace(model, curves=(ramp, shorter))


def finest() -> Model:
    """Problem 3.3 on the medium mesh in steps half as long, with Newton's tolerances a hundredth."""
    control = replace(
        indentation.CONTROL,
        steps=round(END_33 / indentation.CONTROL.step),
        displacement_tolerance=1e-5,
        pressure_tolerance=1e-4,
        concentration_tolerance=1e-4,
    )
    model = Indentation(grid=LEVELS[1], control=control, name="cost-3.3-finest").model()
    return in_more_steps(model, 2.0)


_BUILDERS: dict[Problem, Callable[[Point, InterfaceType], Model]] = {
    Problem.DIFFUSION: _cubes(Diffusion(), 2000.0),
    Problem.CONVECTION: _cubes(Convection(), 20000.0),
    Problem.INDENTATION: _indentation,
}


def points(problems: Sequence[Problem]) -> list[Point]:
    """All points of the sweep, with what the plugin's interface alone knows for that one alone."""
    return [
        Point(problem, interface, parameter, float(value))
        for problem in problems
        for interface in INTERFACES
        for parameter, values in (VALUES_33 if problem is Problem.INDENTATION else VALUES).items()
        for value in values
        if parameter not in OWN or interface is InterfaceType.MIXTURE
    ]
