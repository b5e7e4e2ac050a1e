"""Reported scenes with materials, parameters of contact, sides and solver drawn at random, from seeds."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

import numpy as np

from studies.models.small import Scheme
from studies.synthetic_scenes.reported.kinds_of_scene import SCENES as REPORTED
from studies.synthetic_scenes.reported.sketch import Drawn, Sketch, Touch
from studies.synthetic_scenes.reported.words import TWO_PASS, Material, auglag, auto, friction

Random = np.random.Generator
SEEDS = 1000  # how many scenes there are
STIFF, FLUID = ("E", "c1", "c2", "k"), ("perm", "free_diff", "diff")  # parameters of a material that change together
DRAWN = re.compile(r"<(laugon|tolerance|auto_penalty|penalty|two_pass|fric_coeff)>([^<]*)</\1>")
"""Parameters of a contact that are drawn; all others stay."""
MOST_FRICTION, LARGEST_RATIO = 0.5, 0.49


@dataclass(frozen=True)
class Varied:
    """The scene of a seed."""

    seed: int

    @property
    def about(self) -> str:
        """The reported scene that it comes from."""
        return f"{_drawn(self.seed)[0]}, varied"

    def write(self, name: str, folder: Path) -> Path:
        """Write ``<name>.feb`` into `folder`, and return its path."""
        return Drawn(self.about, lambda: _drawn(self.seed)[1]).write(name, folder)


@lru_cache(maxsize=4)
def _drawn(seed: int) -> tuple[str, Sketch]:
    """The name of a reported scene, and the scene of the seed."""
    random = np.random.default_rng(seed)
    name, sketch = next(_sketches(random))
    return name, varied(sketch, random)


def _sketches(random: Random) -> Iterator[tuple[str, Sketch]]:
    """Reported scenes in a random order, without those that are whole documents."""
    names = list(REPORTED)
    for n in random.permutation(len(names)):
        made = REPORTED[names[n]].draw()
        if isinstance(made, Sketch):
            yield names[n], made


def varied(sketch: Sketch, random: Random) -> Sketch:
    """The same bodies and loads; materials, contacts and solver are drawn."""
    return replace(
        sketch,
        materials={body: _material(material, random) for body, material in sketch.materials.items()},
        contacts=_contacts(sketch, random),
        scheme=_scheme(sketch.scheme, random),
    )


def _material(material: Material, random: Random) -> Material:
    """Half to twice as stiff, a tenth to ten times as permeable, any ratio of Poisson."""
    kind, inner = material
    stiff, open_ = 2.0 ** random.uniform(-1.0, 1.0), 10.0 ** random.uniform(-1.0, 1.0)
    ratio = random.uniform(0.0, LARGEST_RATIO)
    for tags, factor in ((STIFF, stiff), (FLUID, open_)):
        inner = _multiplied(inner, tags, factor)
    return kind, re.sub(r"<v>[^<]*<", f"<v>{ratio:.3f}<", inner)


def _multiplied(text: str, tags: Sequence[str], factor: float) -> str:
    """The same with the numbers in some tags multiplied."""
    number = re.compile(rf"(<(?:{'|'.join(tags)})>)([^<]*)<")
    return number.sub(lambda match: f"{match[1]}{float(match[2]) * factor:.6g}<", text)


def _contacts(sketch: Sketch, random: Random) -> tuple[Touch, ...]:
    """One choice for all contacts of a scene; penalties that are given in numbers stay."""
    augmented, two_pass, exchanged = random.random(3) < (0.25, 0.3, 0.2)
    mu = random.uniform(0.05, MOST_FRICTION) if random.random() < 0.3 else 0.0
    factor, tolerance = 10.0 ** random.uniform(-1.0, 1.0), 10.0 ** random.uniform(-2.0, -0.7)
    further = (TWO_PASS if two_pass else "") + (friction(mu) if mu else "")

    def drawn(touch: Touch) -> Touch:
        if "<auto_penalty>0" in touch.params:
            return touch
        params = auglag(factor, tolerance, further) if augmented else auto(factor, further)
        swapped = exchanged and not _is_shell(sketch, touch)
        first, second = (touch.secondary, touch.primary) if swapped else (touch.primary, touch.secondary)
        return Touch(first, second, touch.kind, params + DRAWN.sub("", touch.params))

    return tuple(drawn(touch) for touch in sketch.contacts)


def _is_shell(sketch: Sketch, touch: Touch) -> bool:
    """Whether a side of a contact lies on shells, which have two faces."""
    return any(sketch.bodies[side.rsplit("-", 1)[0]].thickness > 0 for side in (touch.primary, touch.secondary))


def _scheme(scheme: Scheme, random: Random) -> Scheme:
    """Full Newton iterations or updates between matrices; half, the same or twice as many steps."""
    method, updates = (("BFGS", 0), ("BFGS", 0), ("BFGS", 10), ("Broyden", 10))[int(random.integers(4))]
    times = (0.5, 1.0, 1.0, 2.0)[int(random.integers(4))]
    steps = max(1, round(scheme.steps * times))
    size = scheme.size * scheme.steps / steps
    return replace(scheme, method=method, updates=updates, steps=steps, size=size)


SCENES: Mapping[str, Varied] = {f"seed-{seed:03d}": Varied(seed) for seed in range(SEEDS)}
