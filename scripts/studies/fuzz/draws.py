"""What a seed stands for: a scene or a set of parameters, drawn within bounds."""

from collections.abc import Callable
from dataclasses import replace
from enum import Enum

import numpy as np

from harness.models.document import Model
from harness.models.interface import ContactSettings
from harness.models.parts import Mixture, Param, Solid, Solute
from harness.preflight.contact_types import MIXTURE
from harness.preflight.plugin_types import PLUGIN_TYPES
from studies.hard_cases.catalogue import on_corner, rotation, wedge
from studies.hard_cases.press import Press
from studies.hard_cases.pushed import Pushed, Shape, along, faces, slab, turned
from studies.hard_cases.scene import Fineness, Interface
from studies.models.assembly import box

Random = np.random.Generator


class Kind(str, Enum):
    """What is drawn."""

    SCENES = "scenes"
    PARAMETERS = "parameters"


def draw(kind: Kind, seed: int, *, integration: str | None = None) -> Model:
    """The model of a seed; with the given `integration` of a scene instead of the one that is drawn."""
    random = np.random.default_rng(seed)
    model = _scene(random, integration) if kind is Kind.SCENES else _parameters(random)
    return replace(model, name=f"{kind.value}-{seed}")


def _log(random: Random, low: float, high: float) -> float:
    """Between two positive numbers, all orders of magnitude alike."""
    return float(10.0 ** random.uniform(np.log10(low), np.log10(high)))


def _material(random: Random) -> Mixture:
    diffusivity = _log(random, 1e-5, 1e-2)
    solute = Solute(1, diffusivity * random.uniform(0.3, 1.0), diffusivity, _log(random, 0.05, 2.0))
    solid = Solid(_log(random, 1e-2, 1e2), random.uniform(0.0, 0.45))
    return Mixture(solid, _log(random, 1e-5, 1e-1), random.uniform(0.3, 0.95), (solute,))


def _settings(random: Random) -> ContactSettings:
    """Sensible parameters: enforcement, passes, quadrature, factors within a thousand of the default."""
    base = ContactSettings(two_pass=bool(random.integers(2)) or None)
    if random.random() < 0.5:
        base = replace(base, extra=(Param("integration_order", int(random.integers(1, 6))),))
    if random.random() < 0.3:
        factor = _log(random, 1.0, 1e3)
        base = replace(base, auto_penalty=True, penalty=factor, pressure_penalty=factor, concentration_penalty=factor)
    if random.random() < 0.3:
        base = replace(base, laugon="AUGLAG", tolerance=_log(random, 1e-4, 1e-1))
    return base


def _scene(random: Random, integration: str | None) -> Model:
    """Two confined blocks, or a turned block that is pushed into a slab and along it."""
    made = _pressed(random) if random.random() < 0.5 else _pushed(random)
    settings = _settings(random)
    drawn = (None, "gauss", "segments")[int(random.integers(3))]
    contact = replace(made.contacts[0], params=replace(settings, integration=integration or drawn).params())
    return replace(made, contacts=(contact,))


def _pressed(random: Random) -> Model:
    times = tuple(float(t) for t in np.cumsum(10.0 ** random.uniform(0.0, 3.5, size=12)))
    way = np.concatenate([random.uniform(-2.0, 1.0, size=11), [1.0]])
    path = ((0.0, 0.0), *zip(times, way.tolist(), strict=True))
    scene = Press(
        lower=_material(random),
        upper=_material(random),
        gap=random.uniform(-0.02, 0.05),
        shortening=random.uniform(0.01, 0.1),
        path=path,
        times=times,
        width=(random.uniform(0.2, 2.0), random.uniform(0.2, 2.0)),
        across=(int(random.integers(1, 4)), int(random.integers(1, 4))),
        warp=random.uniform(0.0, 0.1) if random.random() < 0.3 else 0.0,
        below=(random.uniform(0.0, 2.0),),
        above=(random.uniform(0.0, 2.0),),
    )
    return scene.model(Fineness.COARSE, Interface.MIXTURE)


def _pushed(random: Random) -> Model:
    pressed, end = np.sort(10.0 ** random.uniform(1.0, 4.0, size=2))
    deep, along_x = random.uniform(0.02, 0.12), random.uniform(-0.5, 0.5)
    motion = along(((0.0, (0.0, 0.0, 0.0)), (float(pressed), (0.0, 0.0, -deep)), (float(end), (along_x, 0.0, -deep))))
    times = (*np.linspace(0.0, pressed, 7)[1:], *np.linspace(pressed, end, 9)[1:])
    shape, plane = _shape(random)
    nx, nz = (int(n) for n in random.integers(4, 9, size=2))
    half = 0.125 if plane else 0.9
    scene = Pushed(
        lambda _: slab((-1.2, -half, -0.8), (1.2, half, 0.0), (nx, 1 if plane else 4, nz // 2)),
        lambda _: shape,
        motion,
        tuple(float(t) for t in times),
        lambda _: [],
        plane=plane,
        base_is_primary=bool(random.integers(2)),
    )
    made = scene.model(Fineness.COARSE, Interface.MIXTURE)
    return replace(made, materials={"gel": _material(random)})


def _shape(random: Random) -> tuple[Shape, bool]:
    """An edge, a corner, or a flat face that is tilted a little; and whether the scene is plane."""
    choice = int(random.integers(3))
    if choice == 0:
        edge = wedge(1)
        return replace(edge, body=replace(edge.body, nodes=edge.body.nodes - np.array([0.0, 0.125, 0.0]))), True
    if choice == 1:
        return on_corner(1), False
    n = int(random.integers(1, 5))
    body = box((-0.4, -0.125, 0.0), (0.4, 0.125, 0.5), (n, 1, n))
    flat = Shape(body, faces(body, "z", 0.0), np.unique(faces(body, "z", 0.5)))
    return turned(flat, rotation((0.0, 1.0, 0.0), random.uniform(-8.0, 8.0)), np.array([0.0, 0.0, 0.06])), True


Value = Callable[[Random], float | int | str]
_ANYTHING: tuple[Value, ...] = (
    lambda random: float(random.normal()),
    lambda random: _log(random, 1e-300, 1e300),
    lambda random: -_log(random, 1e-3, 1e3),
    lambda random: int(random.integers(-3, 20)),
    lambda random: str(
        random.choice(["nan", "inf", "-inf", "", " ", "AUGLAG", "penalty", "1,2,3", "0x10", "1e999", "é"])
    ),
)
PARAMETERS = [*(parameter.name for parameter in PLUGIN_TYPES[MIXTURE]), "penalti"]
"""What may be set; the last does not exist."""


def _parameters(random: Random) -> Model:
    """One to four parameters of two confined blocks, each with anything for a value."""
    model = Press(gap=1e-3, times=(100.0, 500.0, 1000.0, 5000.0), across=(1, 1)).model(
        Fineness.COARSE, Interface.MIXTURE
    )
    names = random.choice(PARAMETERS, size=int(random.integers(1, 5)), replace=False)
    params = tuple(Param(str(name), _ANYTHING[int(random.integers(len(_ANYTHING)))](random)) for name in names)
    return replace(model, contacts=(replace(model.contacts[0], params=params),))
