"""The hard cases of friction, in one table: scenes that are run with friction and without it."""

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from harness.models.parts import Param
from harness.post.compare import Measure
from harness.run.runner import RunResult
from studies.closed_forms import incline
from studies.hard_cases.catalogue import CORNER, CURVED, EDGE, PRESSED, TURNED, slider
from studies.hard_cases.pushed import Pushed, Shape, along, grip_force, slab, spinning
from studies.models.pieces import Motion

FRICTION, SOLID_FRACTION = 0.3, 0.1  # mu_eq and phi of the cases that do not say otherwise
TILT = 0.05 / 0.25  # largest slope of the contact: a block of 0.5 mm sinks in by no more than 0.05 mm
Path = tuple[tuple[float, tuple[float, float, float]], ...]


def rubs(friction: float = FRICTION, solid_fraction: float = SOLID_FRACTION) -> tuple[Param, ...]:
    """Parameters of an interface with friction."""
    return (Param("fric_coeff", friction), Param("contact_frac", solid_fraction))


def track(factor: int) -> Shape:
    """A slab of 2 mm."""
    return slab((0.0, 0.0, -0.5), (2.0, 0.25, 0.0), (8 * factor, 1, 2 * factor))


def block(factor: int, start: float = 0.7) -> Shape:
    """A block of 0.5 mm on it."""
    return slider(0.5, 3 * factor, start)


def every(step: float, end: float) -> tuple[float, ...]:
    """Ends of even steps, s."""
    return tuple(step * k for k in range(1, round(end / step) + 1))


def held_back(run: RunResult, friction: float, least: float) -> list[Measure]:
    """The largest force along the contact over mu times the normal one, while that is a tenth of its largest or more.

    Not less than `least`; nor more than a slope of `TILT` adds to friction, as on an incline.
    """
    force = np.abs(grip_force(run))
    pressed = force[:, 2] > 0.1 * force[:, 2].max()
    found = float((force[pressed, 0] / force[pressed, 2]).max()) / friction
    most = incline.force_over_weight(TILT, friction) / friction
    return [Measure("largest force along the contact over friction's, relative", found, most, lowest=least)]


def free(run: RunResult) -> list[Measure]:  # noqa: ARG001 other scenes look at the run
    """Nothing is asked of the forces: the contact is not flat, or the fluid pulls."""
    return []


@dataclass(frozen=True)
class Rubbing:
    """A hard case of friction."""

    about: str  # what is hard about it, in a few words
    scene: Pushed  # with the parameters of friction

    @property
    def frictionless(self) -> Pushed:
        """The same scene without friction."""
        return replace(self.scene, name=f"{self.scene.name}-frictionless", extra=())


def _slide(
    path: Path,
    times: tuple[float, ...],
    *,
    friction: float = FRICTION,
    solid_fraction: float = SOLID_FRACTION,
    least: float = 0.5,
) -> Pushed:
    bounds = partial(held_back, friction=friction, least=least)
    return Pushed(track, block, along(path), times, bounds, extra=rubs(friction, solid_fraction))


def _with(scene: Pushed, motion: Motion, times: tuple[float, ...]) -> Pushed:
    """A scene of the frictionless hard cases with friction, its own motion and times."""
    return replace(scene, motion=motion, times=times, bounds=free, extra=(*scene.extra, *rubs()))


def _zigzag(start: float, period: float, cycles: int, way: float, depth: float) -> Path:
    """There and back along x from the place where it is pressed down."""
    turns = [(start + period * (k + 0.5) / 2.0, way * (-1.0) ** k) for k in range(2 * cycles)]
    return tuple((time, (x, 0.0, -depth)) for time, x in turns)


THERE_AND_BACK = (*PRESSED, *_zigzag(1000.0, 400.0, 10, 0.15, 0.03))
STICK_SLIP_STICK = (
    *PRESSED,
    (1500.0, (0.1, 0.0, -0.03)),
    (1700.0, (0.1, 0.0, -0.05)),
    (1900.0, (0.102, 0.0, -0.05)),
    (2100.0, (0.102, 0.0, -0.02)),
    (2600.0, (0.3, 0.0, -0.02)),
)
LIFTED_IN_SLIP = (
    *PRESSED,
    (1500.0, (0.1, 0.0, -0.03)),
    (2000.0, (0.3, 0.0, 0.02)),
    (2200.0, (0.4, 0.0, 0.02)),
    (2700.0, (0.5, 0.0, -0.03)),
)
DOWN_AND_ALONG = ((0.0, (0.0, 0.0, 0.01)), (1000.0, (0.0, 0.0, -0.12)), (2000.0, (0.3, 0.0, -0.12)))
SUCKED = (
    *PRESSED,
    (3000.0, (0.05, 0.0, -0.03)),
    (3010.0, (0.06, 0.0, -0.02)),
    (3100.0, (0.15, 0.0, -0.02)),
)

CASES: dict[str, Rubbing] = {
    "reversal": Rubbing("reversal of sliding, ten cycles", _slide(THERE_AND_BACK, every(50.0, 5000.0))),
    "stick-slip-stick": Rubbing("stick to slip to stick", _slide(STICK_SLIP_STICK, every(50.0, 2600.0))),
    "touch-in-motion": Rubbing(
        "first touch while sliding",
        _slide(((0.0, (0.0, 0.0, 0.01)), (1000.0, (0.4, 0.0, -0.04))), every(25.0, 1000.0), least=0.3),
    ),
    "over-an-edge": Rubbing(
        "sliding over an edge until 40 % remain",
        replace(_slide((*PRESSED, (2000.0, (0.7, 0.0, -0.03))), every(50.0, 2000.0)), shape=partial(block, start=1.1)),
    ),
    "lost-in-slip": Rubbing("loss of contact in slip, and touch again", _slide(LIFTED_IN_SLIP, every(50.0, 2700.0))),
    "mu-1": Rubbing("mu = 1", _slide((*PRESSED, (2000.0, (0.5, 0.0, -0.03))), every(50.0, 2000.0), friction=1.0)),
    "fluid-bears-all": Rubbing(
        "phi = 0, and the fluid bears nearly all of the load",
        _slide(
            ((0.0, (0.0, 0.0, 0.0)), (1.0, (0.0, 0.0, -0.03)), (5.0, (0.4, 0.0, -0.03))),
            every(0.1, 5.0),
            solid_fraction=0.0,
            least=0.0,
        ),
    ),
    "suction": Rubbing(
        "suction: the fluid pulls while the contact slides",
        replace(_slide(SUCKED, (*every(100.0, 3000.0), *(3000.0 + t for t in every(2.0, 100.0)))), bounds=free),
    ),
    "rotation": Rubbing(
        "a body turned by 90 degrees in contact",
        _with(TURNED, spinning(0.03, 1000.0, 5000.0, 90.0), every(125.0, 5000.0)),
    ),
    "twenty-facets": Rubbing(
        "large sliding over many facets",
        replace(
            _slide((*PRESSED, (5000.0, (1.0, 0.0, -0.03))), every(100.0, 5000.0), least=0.9),
            shape=partial(block, start=0.2),
        ),
    ),
    "round-on-round": Rubbing("curved on curved, facet ratio 1:8", replace(CURVED, bounds=free, extra=rubs())),
    "edge": Rubbing(
        "an edge pressed into a face and drawn along it", _with(EDGE, along(DOWN_AND_ALONG), every(50.0, 2000.0))
    ),
    "corner": Rubbing(
        "a corner pressed into a face and drawn along it", _with(CORNER, along(DOWN_AND_ALONG), every(50.0, 2000.0))
    ),
    "fast-and-drained": Rubbing(
        "phi = 0.5, pressed at once, and sliding until the load has drained",
        _slide(
            ((0.0, (0.0, 0.0, 0.0)), (1.0, (0.0, 0.0, -0.03)), (4001.0, (0.4, 0.0, -0.03))),
            (*every(0.25, 1.0), *(1.0 + 100.0 * k for k in range(1, 41))),
            solid_fraction=0.5,
            least=0.9,
        ),
    ),
}
"""By name. Each runs on two meshes, with friction and without, and with FEBio's friction."""
CASES = {name: replace(case, scene=replace(case.scene, name=f"rubbing-{name}")) for name, case in CASES.items()}
