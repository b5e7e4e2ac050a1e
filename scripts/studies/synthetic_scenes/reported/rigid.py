"""Rigid cams, punches, wheels and plates against rigid and soft bodies, nearly incompressible ones among them."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np

from studies.models.small import Scheme, fixed
from studies.synthetic_scenes.reported.shapes import Place, arc, ball, box, mapped, scaled, shell, shifted, turned
from studies.synthetic_scenes.reported.sketch import USUAL, Drawn, Sketch, Touch
from studies.synthetic_scenes.reported.words import (
    TWO_PASS,
    Material,
    auglag,
    auto,
    biphasic,
    drained,
    fluid,
    friction,
    given,
    hold,
    mooney,
    neo,
    ogden,
    press,
    push,
    radius,
    rigid,
    shift,
    spin,
)

TURN = 2.0 * np.pi


@dataclass(frozen=True)
class Cam:
    """A rigid cam turns under a follower that a force presses onto it."""

    eccentric: float
    stretch: float = 1.0
    soft: bool = False
    params: str = given(50.0)

    def __call__(self) -> Sketch:
        follower = mapped((8, 2, 2), box((-1.2, -0.4, 0.99), (1.8, 0.4, 1.4)))
        disc = scaled(turned(arc(0.3, 1.0, 0.6), "x", 90.0), (self.stretch, 1.0, 1.0))  # along y
        held = fixed("follower-z1", "x", "y") if self.soft else hold("follower", "xyuvw")
        pressed = press("follower-z1", 0.05, 4) if self.soft else push("follower", "z", -0.1, 4)
        return Sketch(
            {"cam": mapped((1, 48, 2), shifted(disc, (self.eccentric, 0.0, 0.0))), "follower": follower},
            {"cam": rigid(), "follower": neo(5.0) if self.soft else rigid((0.3, 0.0, 1.2))},
            (Touch("cam-x1", "follower-z0", params=self.params),),
            (hold("cam", "xyzuw"), spin("cam", "Rv", TURN, 1), held, pressed),
            Scheme(50, 0.02),
        )


@dataclass(frozen=True)
class Punch:
    """A rigid punch is pressed into a block by a force; it may be free to tilt."""

    place: Place
    cells: tuple[int, int, int]
    material: Material
    params: str = auto(1.0)
    face: str = "z0"
    free: bool = False
    scheme: Scheme = USUAL
    primary: bool = True

    def __call__(self) -> Sketch:
        sides = (f"punch-{self.face}", "block-z1") if self.primary else ("block-z1", f"punch-{self.face}")
        return Sketch(
            {
                "punch": mapped(self.cells, self.place),
                "block": mapped((8, 8, 3), box((-1.5, -1.5, -1.0), (1.5, 1.5, 0.0))),
            },
            {"punch": rigid((0, 0, 0.5)), "block": self.material},
            (Touch(*sides, params=self.params),),
            (fixed("block-z0"), hold("punch", "xyw" if self.free else "xyuvw"), push("punch", "z", -0.3)),
            self.scheme,
        )


FLAT = box((-0.6, -0.6, -0.01), (0.6, 0.6, 1.0))
ROUND = shifted(ball(1.0), (0.0, 0.0, 0.93))


def wheel(mu: float) -> Sketch:
    """A rigid wheel is pressed into a soft slab and rolls on it."""
    disc = shifted(turned(arc(0.5, 1.0, 0.6), "x", 90.0), (0.0, 0.0, 1.01))
    return Sketch(
        {"wheel": mapped((1, 40, 3), disc), "slab": mapped((16, 4, 3), box((-1, -0.5, -0.8), (2.2, 0.5, 0.0)))},
        {"wheel": rigid((0, 0, 1.01)), "slab": neo()},
        (Touch("slab-z1", "wheel-x1", params=auto(1.0, friction(mu))),),
        (
            fixed("slab-z0"),
            hold("wheel", "yuw"),
            shift("wheel", "z", -0.1),
            shift("wheel", "x", 1.0, 2),
            spin("wheel", "Rv", 1.0, 2),
        ),
        Scheme(30, 1.0 / 15.0),
    )


@dataclass(frozen=True)
class BetweenPlates:
    """A soft body that is held at one side between two rigid plates of shells, its skin a surface of both contacts."""

    material: Material
    params: str = auto(1.0, radius(0.5))
    element: str = "tet4"
    way: float = 0.3
    updates: int = 0
    kind: str = "sliding-elastic"
    module: str = "solid"
    sides: tuple[str, str] = ("outside", "outside")

    def __call__(self) -> Sketch:
        cells = (3, 3, 2) if self.element in ("tet10", "hex20") else (6, 6, 4)

        def bulging(u: np.ndarray) -> np.ndarray:
            points = box((0.0, -1.0, 0.0), (2.0, 1.0, 1.0))(u)
            taper = 1.0 - 0.12 * u[:, 0] ** 2
            return np.asarray(np.column_stack([points[:, :2], 0.5 + (points[:, 2] - 0.5) * taper]))

        low = shell((6, 6), box((-0.4, -1.2, -0.01), (2.4, 1.2, -0.01)), 0.05)
        high = shell((6, 6), box((2.4, -1.2, 1.01), (-0.4, 1.2, 1.01)), 0.05)
        return Sketch(
            {"body": mapped(cells, bulging, self.element), "low": low, "high": high},
            {"body": self.material, "low": rigid(), "high": rigid((0, 0, 1))},
            tuple(
                Touch(f"body-{side}", f"{plate}-face", self.kind, self.params)
                for side, plate in zip(self.sides, ("low", "high"), strict=True)
            ),
            (
                fixed("body-x0"),
                *([drained("body-x1")] if self.module == "biphasic" else []),
                hold("low", "xyuvw"),
                hold("high", "xyuvw"),
                shift("low", "z", self.way / 2),
                shift("high", "z", -self.way / 2),
            ),
            Scheme(updates=self.updates),
            module=self.module,
        )


SCENES: Mapping[str, Drawn] = {
    "cam": Drawn("a rigid cam under a rigid follower", Cam(0.3)),
    "cam-pointed": Drawn("a rigid ellipse under a rigid follower", Cam(0.0, 1.4)),
    "cam-augmented": Drawn(
        "a rigid cam under a rigid follower, augmented",
        Cam(0.3, params="<laugon>AUGLAG</laugon><tolerance>0.1</tolerance><penalty>10</penalty>"),
    ),
    "cam-soft-follower": Drawn("a rigid cam under a soft follower", Cam(0.2, 1.1, soft=True, params=auto(1.0))),
    "punch-flat-tilts": Drawn(
        "a flat rigid punch that may tilt, under a force", Punch(FLAT, (6, 6, 2), neo(), free=True)
    ),
    "punch-flat-block-first": Drawn(
        "a flat rigid punch, the block as primary surface", Punch(FLAT, (1, 1, 1), neo(), primary=False)
    ),
    "punch-round-ogden-augmented": Drawn(
        "a rigid sphere on an Ogden block under a force, augmented", Punch(ROUND, (5, 5, 5), ogden(), auglag(1.0))
    ),
    "punch-round-ogden-augmented-outside": Drawn(
        "a rigid sphere on an Ogden block under a force, augmented, whole outside, the block as primary surface",
        Punch(ROUND, (5, 5, 5), ogden(), auglag(1.0), "outside", primary=False),
    ),
    "punch-round-friction": Drawn(
        "a rigid sphere under a force, friction 0.4, AUGLAG with a small penalty",
        Punch(ROUND, (5, 5, 5), mooney(), auglag(0.1, 0.1, friction(0.4))),
    ),
    "punch-incompressible-bfgs": Drawn(
        "a rigid sphere on a block of Poisson's ratio 0.4999, BFGS",
        Punch(ROUND, (5, 5, 5), neo(1.0, 0.4999), scheme=Scheme(updates=10)),
    ),
    "punch-incompressible": Drawn(
        "a rigid sphere on a block of Poisson's ratio 0.4999, full Newton", Punch(ROUND, (5, 5, 5), neo(1.0, 0.4999))
    ),
    "punch-mooney-stiff-bulk": Drawn(
        "a flat punch on a Mooney-Rivlin block with a bulk modulus of 5000 times the shear modulus",
        Punch(FLAT, (6, 6, 2), mooney(0.2, 0.0, 2000.0), auto(1.0, TWO_PASS)),
    ),
    "wheel-rolls": Drawn("a rigid wheel rolls on a soft slab, friction 0.3", partial(wheel, 0.3)),
    "plates-tet4": Drawn("soft tetrahedra between rigid plates, whole outside", BetweenPlates(ogden(0.3, 2.0, 10.0))),
    "plates-tet4-bfgs": Drawn(
        "soft tetrahedra between rigid plates, whole outside, BFGS", BetweenPlates(ogden(0.3, 2.0, 10.0), updates=10)
    ),
    "plates-hex8-deep": Drawn(
        "soft hexahedra between rigid plates, squeezed by half",
        BetweenPlates(ogden(0.3, 2.0, 5.0), element="hex8", way=0.5),
    ),
    "plates-tet10-incompressible": Drawn(
        "tet10 of Poisson's ratio 0.499 between rigid plates", BetweenPlates(neo(1.0, 0.499), element="tet10", way=0.2)
    ),
    "plates-friction-augmented": Drawn(
        "a soft body between rigid plates, friction 0.3, AUGLAG with a small penalty",
        BetweenPlates(neo(1.0, 0.45), auglag(0.2, 0.1, radius(0.5) + friction(0.3)), "hex8", sides=("z0", "z1")),
    ),
    "plates-biphasic": Drawn(
        "a porous body between rigid plates",
        BetweenPlates(
            biphasic(), auto(1.0, radius(0.5) + fluid(1.0)), "hex8", kind="sliding-biphasic", module="biphasic"
        ),
    ),
}
