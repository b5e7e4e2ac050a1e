"""The hard cases: each a scene with its physical check, in one table."""

from dataclasses import replace
from functools import partial

import numpy as np

from harness.arrays import Array
from harness.models.parts import Mixture, Param, Solid, Solute, TimeStepper
from harness.post.compare import Measure
from harness.run.runner import RunResult
from studies.hard_cases.press import HOLD, RAMP, Press
from studies.hard_cases.pressed_variations import (
    AgainstReference,
    CutBack,
    InOtherUnits,
    Restarted,
    Soft,
    Steady,
    spiked,
)
from studies.hard_cases.pushed import (
    Pushed,
    Shape,
    along,
    arc,
    cube,
    faces,
    grip_force,
    mirrored,
    slab,
    spinning,
    steady_slide,
    turned,
)
from studies.hard_cases.scene import GEL, Case
from studies.hard_cases.together import Dropped, Seesaw
from studies.hard_cases.uniaxial import Uniaxial
from studies.models.assembly import box

OSCILLATION = 2.0
"""Where a layer at the outlet is thinner than an element the conforming reference oscillates about it, too."""


def with_solute(diffusivity: float, solubility: float = 1.0, permeability: float = GEL.permeability) -> Mixture:
    """The usual gel with other properties of transport."""
    return replace(GEL, permeability=permeability, solutes=(Solute(1, diffusivity, diffusivity, solubility),))


def stiff(gel: Mixture) -> Mixture:
    """The same gel, a hundred times as stiff, so that the flow does not crush it."""
    return replace(gel, solid=Solid(100.0))


Through = partial(
    AgainstReference, inlet=0.4, shortening=0.01, gap=1e-7, across=(2, 2), below=(1.0,), above=(0.9,), initial=(1.0,)
)
"""A flow through both blocks, at Pe = 1 with the usual gel, and a layer of less solute at the outlet."""
SHARP = 0.5  # conditions hold as averages around nodes: at an edge or a corner the error is a part of a facet
SOFT = 0.2
"""Where penalties are soft the case itself checks how deep the overlap is; it cannot exceed what the blocks are
shortened by, 0.05 mm on facets of 0.25 mm."""
TWO = replace(GEL, solutes=(Solute(1), Solute(2)))
DIFFUSION_TIME = 2000.0  # L^2/d of one block of the usual gel, s
DECADES = tuple(float(t) for t in DIFFUSION_TIME * 10.0 ** np.arange(-6.0, 4.01, 0.5))
LOG_TIMES = tuple(float(t) for t in 100.0 * 10.0 ** np.arange(0.0, 9.1, 0.5))
"""To beyond the diffusion time of a body that is 1e6 times as slow, s."""
LOG_PATH = ((0.0, 0.0), *zip(LOG_TIMES, np.linspace(0.1, 1.0, len(LOG_TIMES)).tolist(), strict=True))
"""Something moves in each step."""
CYCLES = tuple((100.0 * k, 1.0 if k % 2 else -1.0) for k in range(1, 21))  # ten times closed and opened
TO_THE_END = tuple(5000.0 + 4000.0 * k for k in range(6))
STEPS_40 = tuple(float(t) for t in range(50, 2001, 50))
PUSH = tuple(float(t) for t in range(50, 1001, 50))


def rotation(axis: tuple[float, float, float], degrees: float) -> Array:
    """Rotation matrix (Rodrigues)."""
    n = np.array(axis) / np.linalg.norm(axis)
    cross = np.array([[0.0, -n[2], n[1]], [n[2], 0.0, -n[0]], [-n[1], n[0], 0.0]])
    angle = np.radians(degrees)
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross)


def wedge(factor: int) -> Shape:
    """A prism on its edge, above the origin."""
    n = 3 * factor
    body = box((0.0, 0.0, 0.0), (0.8, 0.25, 0.8), (n, 1, n))
    upright = Shape(body, faces(body, "xz", 0.0), np.unique(faces(body, "xz", 0.8)))
    return turned(upright, rotation((0.0, 1.0, 0.0), -45.0), np.array([0.0, 0.0, 0.01]))


def on_corner(factor: int) -> Shape:
    """A cube on its corner, above the origin; y = 0 is a plane of symmetry."""
    n = 3 * factor
    diagonal = np.array([1.0, 1.0, 1.0]) / np.sqrt(3.0)
    first = np.array([1.0, 1.0, -2.0]) / np.sqrt(6.0)
    frame = np.stack([first, np.cross(diagonal, first), diagonal])
    return turned(cube(0.8, (n, n, n), "xyz"), frame, np.array([0.0, 0.0, 0.01]))


def slider(width: float, elements: int, start: float) -> Shape:
    """A block with its lower face at z = 0, from x = `start` (mm)."""
    body = box((start, 0.0, 0.0), (start + width, 0.25, 0.5), (elements, 1, elements))
    return Shape(body, faces(body, "z", 0.0), np.unique(faces(body, "z", 0.5)))


def spinner(factor: int) -> Shape:
    """A square block centred on the z axis."""
    n = 2 * factor
    body = box((-0.4, -0.4, 0.0), (0.4, 0.4, 0.6), (n, n, n))
    return Shape(body, faces(body, "z", 0.0), np.unique(faces(body, "z", 0.6)))


def round_base(factor: int) -> Shape:
    """A quarter disk, round side up, with eight times as many facets as `round_top`."""
    return turned(arc(8 * factor, 1.0, 0.0, 0.25), np.diag([1.0, -1.0, -1.0]), np.array([0.0, 0.25, 0.0]))


def round_top(factor: int) -> Shape:
    """A quarter disk, round side down."""
    return arc(factor, 1.0, 0.01, 0.25)


def overhang(run: RunResult) -> list[Measure]:
    """Normal force at the end over that before sliding: less, as 0.4 of the width are left; and it still presses."""
    normal = np.abs(grip_force(run)[:, 2])
    before = normal[np.argmin(np.abs(run.nodes.times - 1000.0))]
    return [Measure("normal force left, relative", float(normal[-1] / before), 0.8, lowest=0.2)]


DOWN = ((0.0, (0.0, 0.0, 0.0)), (1000.0, (0.0, 0.0, -0.15)))
PRESSED = ((0.0, (0.0, 0.0, 0.0)), (1000.0, (0.0, 0.0, -0.03)))
CORNER = Pushed(
    lambda f: slab((-0.8, -0.8, -0.8), (0.8, 0.8, 0.0), (4 * f, 4 * f, 3 * f)),
    on_corner,
    along(DOWN),
    PUSH,
    mirrored(1, 1e-6),
    plane=False,
)
EDGE = Pushed(
    lambda f: slab((-1.0, 0.0, -0.8), (1.0, 0.25, 0.0), (8 * f, 1, 4 * f)), wedge, along(DOWN), PUSH, mirrored(0, 1e-6)
)
TURNED = Pushed(
    lambda f: slab((-0.8, -0.8, -0.6), (0.8, 0.8, 0.0), (4 * f, 4 * f, 2 * f)),
    spinner,
    spinning(0.03, 10000.0, 40000.0, 90.0),
    tuple(float(t) for t in range(1000, 40001, 1000)),
    lambda run: steady_slide(run, 10000.0, 0.02, 0.1),
    plane=False,
)
CURVED = Pushed(round_base, round_top, along(DOWN), PUSH, mirrored(1, 1e-6), half=True, base_is_primary=True)
BOTH_PRESSING = Seesaw(((0.0, -0.1), (1000.0, 1.0)), ((0.0, -0.1), (1000.0, 1.0)))
TWO_PASS = (Param("two_pass", True),)
"""Then each side resolves what is smaller than its facets with the nodes of the other."""

CASES: dict[str, Case] = {
    "touch-gap-element": Case("first touch from a gap of one element", Press(gap=1.0, in_elements=True)),
    "touch-gap-1e-12": Case("first touch from a gap of 1e-12 mm", Press(gap=1e-12, newton=1e-6)),
    "overlap-tenth": Case("initial overlap of 10 % of an element", Press(gap=-0.1, in_elements=True)),
    "ten-cycles": Case(
        "separation and re-contact, ten cycles",
        Press(
            path=((0.0, 0.0), *CYCLES, (2100.0, 1.0)),
            newton=1e-6,
            times=(*(50.0 * k for k in range(1, 43)), *TO_THE_END),
        ),
    ),
    "lost-and-regained": Case(
        "contact lost entirely, then regained",
        Press(
            path=((0.0, 0.0), (500.0, 1.0), (1000.0, -8.0), (1500.0, -8.0), (2000.0, 1.0)),
            newton=1e-6,
            times=(*(50.0 * k for k in range(1, 41)), *TO_THE_END),
        ),
    ),
    "edge-on-face": Case("edge on face", EDGE, pointwise=SHARP, swap=SHARP),
    "corner-on-face": Case("corner on face", CORNER, pointwise=SHARP, swap=SHARP),
    "corner-two-pass": Case("corner on face, two_pass 1", replace(CORNER, extra=TWO_PASS), pointwise=SHARP, swap=SHARP),
    "slide-off-edge": Case(
        "sliding off an edge until 40 % remain",
        Pushed(
            lambda f: slab((0.0, 0.0, -0.5), (2.0, 0.25, 0.0), (8 * f, 1, 2 * f)),
            lambda f: slider(0.8, 4 * f, 1.1),
            along((*PRESSED, (2000.0, (0.58, 0.0, -0.03)))),
            STEPS_40,
            overhang,
        ),
    ),
    "slide-20-facets": Case(
        "large sliding over 20 facets",
        Pushed(
            lambda f: slab((0.0, 0.0, -0.5), (6.0, 0.25, 0.0), (30 * f, 1, 2 * f)),
            lambda f: slider(0.5, 3 * f, 0.6),
            along((*PRESSED, (6000.0, (4.0, 0.0, -0.03)))),
            (500.0, 1000.0, *(1000.0 + 125.0 * k for k in range(1, 41))),
            lambda run: steady_slide(run, 1000.0, 0.1, 0.1),
        ),
    ),
    "rotation-90": Case("rotation of a body by 90 degrees in contact", TURNED),
    "curved-1-to-8": Case("curved on curved, facet ratio 1:8", CURVED),
    "curved-two-pass": Case("curved on curved, facet ratio 1:8, two_pass 1", replace(CURVED, extra=TWO_PASS)),
    "warped-quads": Case("warped quadrilaterals", Press(warp=0.1, gap=1e-4, tolerance=1e-2)),
    "slivers": Case("slivers of aspect 1:100", Press(width=(0.04, 1.0), across=(4, 1), gap=1e-3)),
    "stiffness-1e6": Case(
        "stiffness ratio 1e6", Press(lower=replace(GEL, solid=Solid(1e6)), gap=1e-3, times=(*RAMP, *HOLD[:4]))
    ),
    "permeability-1e8": Case(
        "permeability ratio 1e8",
        AgainstReference(
            upper=with_solute(5e-4, permeability=1e-11),
            inlet=0.01,
            shortening=0.01,
            gap=1e-7,
            path=LOG_PATH,
            times=LOG_TIMES,
            across=(2, 2),
            transient=False,
            newton=1e-6,
        ),
    ),
    "diffusivity-1e6": Case(
        "diffusivity ratio 1e6",
        Press(upper=with_solute(5e-10), path=LOG_PATH, times=LOG_TIMES, gap=1e-3),
    ),
    "solubility-1e3": Case(
        "ratio of effective solubilities 1e3",
        AgainstReference(upper=with_solute(5e-4, 1e-3), shortening=0.01, gap=1e-7, across=(2, 2)),
    ),
    "incompressible": Case("nearly incompressible (nu = 0.49) at instant loading", Uniaxial()),
    "ten-decades": Case(
        "time steps from 1e-6 to 1e4 of the diffusion time in one run",
        Press(
            path=((0.0, 0.0), *zip(DECADES, np.linspace(0.1, 1.0, len(DECADES)), strict=True)), times=DECADES, gap=1e-3
        ),
    ),
    "peclet-1e2": Case(
        "Peclet number 1e2 at the interface",
        Through(lower=stiff(with_solute(5e-6)), upper=stiff(with_solute(5e-6))),
        undershoot=OSCILLATION,
    ),
    "peclet-1e4": Case(
        "Peclet number 1e4 at the interface",
        Through(lower=stiff(with_solute(5e-8)), upper=stiff(with_solute(5e-8))),
        undershoot=OSCILLATION,
    ),
    "no-solute": Case("zero concentration everywhere", Press(below=(0.0,), gap=1e-3)),
    "trace-solute": Case(
        "a solute present at 1e-12 of another",
        Press(lower=TWO, upper=TWO, below=(1.0, 1e-12), above=(0.0, 0.0), gap=1e-3),
    ),
    "units": Case("mm-N-s, m-N-s and um-nN-s", InOtherUnits(gap=1e-3)),
    "penalty-1e-3": Case(
        "penalties 1e-3 of automatic: the overlap is that of an element",
        Soft(penalties=1e-3, gap=1e-3, tolerance=0.2),
        pointwise=SOFT,
    ),
    "penalty-augmented": Case("penalties 1e-3 of automatic, AUGLAG", Press(penalties=1e-3, gap=1e-3, augmented=1e-3)),
    "penalty-1e3": Case("penalties 1e3 of automatic", Press(penalties=1e3, gap=1e-3)),
    "penalty-1e6": Case("penalties 1e6 of automatic", Press(penalties=1e6, gap=1e-3)),
    "three-bodies": Case("three bodies meeting at shared nodes", BOTH_PRESSING),
    "one-closes-one-opens": Case(
        "a node on two interfaces, one closing while the other opens",
        Seesaw(((0.0, 0.0), (200.0, 1.0), (1000.0, -1.0)), ((0.0, -1.0), (200.0, -1.0), (1000.0, 1.0))),
    ),
    "dropped": Case("a traction load with no contact at the start, a soft cushion as regularisation", Dropped()),
    "restart": Case("dump, restart in the middle of contact", Restarted(gap=1e-3)),
    "cutback-at-touch": Case(
        "cutback forced at the moment of first touch",
        CutBack(
            gap=0.05,
            path=spiked(600.0, 1000.0),
            times=(100.0, 12000.0),
            newton=1e-6,
            stepper=TimeStepper(100.0, retries=8, optimal_iterations=10**6, aggressive=True),
        ),
    ),
    "1000-steps": Case(
        "1000 steps at constant state",
        Steady(times=(*RAMP, *(1000.0 + 100.0 * k for k in range(1, 1001))), across=(1, 1), gap=1e-3),
    ),
}
"""By name. Each runs on two meshes, with the plugin's interface and with FEBio's."""
CASES = {name: replace(case, scene=replace(case.scene, name=name)) for name, case in CASES.items()}  # type: ignore[type-var]
