"""A ball in its socket, of tetrahedra, and blocks with many facets: ours, ours with the predictor, and FEBio's own
interface, run in turn.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from statistics import median
from typing import NamedTuple

from harness.errors import DataFileError
from studies import tables, timing
from studies.hard_cases.scene import Interface
from studies.models.ball_in_socket import BallInSocket
from studies.models.pieces import PREDICTOR
from studies.models.pressed_blocks import PressedBlocks
from studies.price import table
from studies.price.scenes import Kind, penalties
from studies.stamps import LIMIT, at_limit
from studies.timing import Announce, Timed

FACTOR = 10.0  # of FEBio's automatic penalties: what its users set
Scene = BallInSocket | PressedBlocks
SCENES: Mapping[str, Scene] = {
    "tet4, pressed": BallInSocket(slides=False),
    "tet4, sliding": BallInSocket(),
    "tet4, sliding, socket primary": BallInSocket(primary="socket"),
    "tet4, sliding, 10 BFGS updates": BallInSocket(updates=10),
    "tet4, biphasic, sliding": BallInSocket(elements=6, porous=True),
    "tet10, pressed": BallInSocket(elements=4, quadratic=True, slides=False),
    "hex8, blocks of 2500 on 2116 facets": PressedBlocks(),
}
"""By what the page calls them."""
OURS, PREDICTED = Interface.MIXTURE.value, Interface.PREDICTED.value
"""What a row calls ours without and with the predictor."""


@dataclass(frozen=True)
class JointPrice:
    """One contact on one scene, from several runs."""

    scene: str
    type: str  # type of the contact; `PREDICTED` for ours with the predictor
    ended: bool
    # Newton iterations, time steps tried again, and matrices formed.
    iterations: int
    retries: int
    matrices: int
    seconds: float  # median of the processor time of the run, s
    # Median, least and largest of that time over that of FEBio's interface, run in turn.
    ratio: float
    ratio_low: float
    ratio_high: float
    share: float  # part of the run's time that the contact takes, of the run with the least part; nan for FEBio's
    points: int  # integration points that face the other surface; 0 for FEBio's
    facets: int  # of the primary surface
    # Equations, and the most entries of the matrix.
    unknowns: int
    entries: int


def rival(scene: Scene) -> Scene:
    """The same scene with FEBio's own interface."""
    kind = Kind.BIPHASIC if scene.porous else Kind.ELASTIC
    return replace(scene, contact=kind.rival, params=penalties(kind, FACTOR).params())


def contacts(scene: Scene) -> dict[str, Scene]:
    """The scene with each contact that is compared, by what a row calls it; FEBio's last."""
    predicted = replace(scene, params=(*scene.params, PREDICTOR))
    theirs = rival(scene)
    return {OURS: scene, PREDICTED: predicted, theirs.contact: theirs}


def measure(scenes: Mapping[str, Scene], repetitions: int, announce: Announce) -> list[JointPrice]:
    """Run the contacts of each scene in turn, `repetitions` times."""
    return [price for name, scene in scenes.items() for price in _prices(name, scene, repetitions, announce)]


def _prices(name: str, scene: Scene, repetitions: int, announce: Announce) -> list[JointPrice]:
    models = {contact: one.model() for contact, one in contacts(scene).items()}
    runs = run(models, repetitions, lambda told: announce(f"{name}: {told}"))
    *_, reference = runs.values()
    mesh = scene.model().mesh
    facets = len(mesh.surfaces[scene.primary])
    return [_price(name, contact, found, reference, facets) for contact, found in runs.items()]


run = partial(timing.interleave, check=False, processor_limit=LIMIT)


def _price(name: str, contact: str, runs: Sequence[Timed], reference: Sequence[Timed], facets: int) -> JointPrice:
    times = [found for _, log in runs for found in table.read(log)]
    share, points = min(((found.share, found.points) for found in times), default=(float("nan"), 0))
    first, log = runs[0]
    counts = (first.report.iterations, first.report.retries, first.report.reformations)
    spent = (median(run.cpu for run, _ in runs), *timing.spread(timing.ratios(runs, reference)))
    size = (facets, table.unknowns(log), table.entries(log))
    return JointPrice(name, contact, all(run.report.normal for run, _ in runs), *counts, *spent, share, points, *size)


class Joint(NamedTuple):
    """A scene with ours, with ours and the predictor, and with FEBio's interface."""

    ours: JointPrice
    predicted: JointPrice
    febio: JointPrice


def arranged(prices: Sequence[JointPrice]) -> list[Joint]:
    """The rows by scene. Raises DataFileError where a scene lacks one of its contacts."""
    scenes = tables.grouped(prices, lambda price: price.scene)
    for name, own in scenes.items():
        if [price.type for price in own[:-1]] != [OURS, PREDICTED]:
            raise DataFileError(f"'{name}' is not there with all contacts; `price --docs` measures it anew")
    return [Joint(*own) for own in scenes.values()]


def headline(joints: Sequence[Joint]) -> str:
    """Range of the times of `sliding-mixture` without the predictor over those of FEBio's interface."""
    times = [ours.ratio for ours, _ in _both(joints)]
    return (
        f"`sliding-mixture` takes {min(times):.2f} to {max(times):.2f} times the time of FEBio's interface in "
        f"{len(times)} of {len(joints)} scenes that both complete."
    )


def details(joints: Sequence[Joint]) -> str:
    """The scenes, the range of iterations, and in how many scenes FEBio's interface is the faster."""
    both = _both(joints)
    slower = sum(ours.ratio > 1.0 for ours, _ in both)
    iterations = [ours.iterations / theirs.iterations for ours, theirs in both]
    return (
        "Most of the scenes are joints with tetrahedra. `sliding-mixture` takes "
        f"{min(iterations):.2f} to {max(iterations):.2f} times the iterations of FEBio's interface. FEBio's interface "
        f"is faster in {slower or 'none'} of the scenes."
    )


def _both(joints: Sequence[Joint]) -> list[tuple[JointPrice, JointPrice]]:
    return [(joint.ours, joint.febio) for joint in joints if joint.ours.ended and joint.febio.ended]


def joints_table(joints: Sequence[Joint]) -> str:
    """The contacts of each scene in one row, as Markdown: ours, then FEBio's."""
    heads = ("scene", "iterations", "retries", "matrices", "time over FEBio's", "part of the contact in the time")
    more = ("points on a primary facet", "matrix entries over FEBio's", "less time")
    return tables.markdown((*heads, *more), map(_row, joints))


def _row(joint: Joint) -> tuple[str, ...]:
    ours, _, theirs = joint
    both = [f"{a}, {b}" for a, b in zip(_counts(ours), _counts(theirs), strict=True)]
    less = theirs if theirs.ended and (not ours.ended or ours.ratio > 1.0) else ours
    points = f"{ours.points / ours.facets:.1f}"
    entries = f"{ours.entries / theirs.entries:.2f}"
    return (ours.scene, *both, _ratio(ours, theirs), f"{100 * ours.share:.0f} %", points, entries, f"`{less.type}`")


def _ratio(price: JointPrice, theirs: JointPrice) -> str:
    both = price.ended and theirs.ended
    return f"{price.ratio:.2f} ({price.ratio_low:.2f} to {price.ratio_high:.2f})" if both else ""


def _counts(price: JointPrice) -> tuple[str, str, str]:
    if not price.ended:
        return (unended(at_limit(price.ended, price.seconds)), "", "")
    return (str(price.iterations), str(price.retries), str(price.matrices))


def unended(limited: bool) -> str:
    """What a table says of a run that did not end: whether the limit ended it."""
    return "ended by the limit" if limited else "fails"
