"""The gallery: models that a user would start from, and what is shown of each."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol

import numpy as np

from harness.arrays import Array
from harness.models import indentation
from harness.models.convection import Convection
from harness.models.diffusion import Diffusion
from harness.models.document import Model
from harness.models.mesh import Mesh
from harness.models.parts import Control, Mixture
from harness.post import solute_balance
from harness.post.section_figures import Section
from harness.run.logdata import History
from harness.run.runner import RunResult
from studies.models import delamination
from studies.models.delamination import Delamination
from studies.models.graft import Graft
from studies.models.joint import Joint
from studies.models.kept_models import DELAMINATION, GRAFT, INDENTATION, JOINT, JOINT_RELEASE, LEVELS, PLATENS, PLUG
from studies.models.platens import Platens
from studies.models.plug import Plug


class Builder(Protocol):
    """What makes a model."""

    def model(self) -> Model:
        """The model."""


@dataclass(frozen=True)
class Entry:
    """A model of the gallery."""

    title: str
    start_here: str  # for which model of one's own it is a start, and what to change
    whole: Builder  # makes the one in models/
    part: Builder  # makes the same with fewer elements and steps, for the tests
    section: Section  # the plane that is drawn
    times: tuple[float, ...]  # of the pictures, s
    driven: tuple[str, str] | None = None  # node set and reaction (Rx, Ry or Rz) whose sum is the force that is shown

    @cached_property
    def model(self) -> Model:
        """The one in models/."""
        return self.whole.model()

    @cached_property
    def small(self) -> Model:
        """The one of the tests."""
        return self.part.model()


@dataclass(frozen=True)
class Curves:
    """What is drawn over time, each of shape (n_times,)."""

    times: Array  # s
    contents: dict[str, Array]  # solute in each porous part, nmol
    sides: dict[str, Array]
    """Mean effective concentration over the nodes of each contact surface whose material has the solute, mM."""
    force: Array | None  # N, of the modelled part; compression is positive


UPRIGHT, MIRRORED = Section(across=0, up=2), Section(mirrored=True)
ENTRIES = (
    Entry(
        "Diffusion through two layers (problem 3.1)",
        "A solute diffuses from a solution through two tissues. Change layers, materials and concentration.",
        Diffusion(plot=True),
        Diffusion(elements=5, control=Control(10, 200.0)),
        UPRIGHT,
        (400.0, 2000.0, 8000.0),
    ),
    Entry(
        "Convection through two layers (problem 3.2)",
        "A pressure difference drives solvent and solute through two layers, to the steady state.",
        Convection(plot=True),
        Convection(elements=5, control=Control(10, 500.0)),
        UPRIGHT,
        (500.0, 2000.0, 20000.0),
    ),
    Entry(
        "A semi-cylinder driven into a slab (problem 3.3)",
        "Start here for indenters and condyles. The deformation is large, and the contact area grows. Open nodes have "
        "the ambient values.",
        INDENTATION,
        replace(
            INDENTATION,
            plot=False,
            grid=LEVELS[0],
            control=replace(indentation.CONTROL, steps=round(indentation.RAMP / indentation.CONTROL.step)),
        ),
        MIRRORED,
        indentation.TIMES,
        ("top", "Ry"),
    ),
    Entry(
        "Cartilage on cartilage under cyclic load",
        "The layers of a joint take up solute from the synovial fluid. Change curvature, loading curve and solute.",
        JOINT,
        Joint(cycles=1, across=10, through=4),
        MIRRORED,
        (20.0, 30.0, 190.0, 200.0),
        ("upper-bone", "Ry"),
    ),
    Entry(
        "Cartilage on cartilage, a solute crosses",
        "A drug or a contrast agent passes from one layer into the other and into the synovial fluid.",
        JOINT_RELEASE,
        replace(JOINT_RELEASE, plot=False, cycles=1, across=10, through=4),
        MIRRORED,
        (20.0, 30.0, 190.0, 200.0),
    ),
    Entry(
        "A graft in a defect, fed across its wall",
        "A press fit joins repair tissue and a host of different material, in three dimensions. Change both materials "
        "and the solution around them.",
        GRAFT,
        Graft(around=2, outward=4, up=2, control=Control(5, 200.0)),
        UPRIGHT,
        (50.0, 500.0, 1500.0, 3000.0),
    ),
    Entry(
        "A permeable platen against an impermeable one",
        "Start here for confined compression and permeation cells. One contact transmits traction, solvent and "
        "solute. The other transmits traction alone, because its platen is impermeable.",
        PLATENS,
        Platens(elements=5, control=Control(10, 100.0)),
        UPRIGHT,
        (100.0, 500.0, 3000.0),
        ("top", "Rz"),
    ),
    Entry(
        "An osteochondral plug on coarser bone",
        "A tie joins meshes that do not match, and a solute crosses it. Change meshes and materials.",
        PLUG,
        Plug(around=(2, 1), up=(4, 2), control=Control(6, 1000.0)),
        UPRIGHT,
        (500.0, 2000.0, 6000.0),
        ("top", "Rz"),
    ),
    Entry(
        "Cartilage that delaminates under shear",
        "A cohesive tie breaks, and fluid enters the crack. Change strength, fracture energy and motion.",
        DELAMINATION,
        Delamination(along=(32, 16), up=(2, 1), control=replace(delamination.CONTROL, steps=30)),
        UPRIGHT,
        (20.0, 40.0, 60.0),
        ("layer-left", "Rx"),
    ),
)
"""The models of the gallery: first the article's problems, then those from practice."""


def curves(entry: Entry, result: RunResult) -> Curves:
    """What is shown of a run over time."""
    history, mesh = result.nodes, result.model.mesh
    states = solute_balance.states(history)
    materials = {part.name: result.model.materials[part.material] for part in mesh.parts}
    porous = [part for part in mesh.parts if isinstance(materials[part.name], Mixture) and materials[part.name].solutes]
    wet = np.unique(np.concatenate([part.elements.ravel() for part in porous]))
    contents = {
        part.name: np.array([solute_balance.content(result.model, part, state) for state in states]) for part in porous
    }
    names = [name for pair in mesh.pairs.values() for name in pair]
    # in the order of their parts, so that both have the same colours
    surfaces = {
        name: np.unique(mesh.surfaces[name])
        for part in mesh.parts
        for name in names
        if np.isin(mesh.surfaces[name], part.elements).all()
    }
    sides = {name: history["c1"][:, ids - 1].mean(axis=1) for name, ids in surfaces.items() if np.isin(ids, wet).all()}
    return Curves(history.times, contents, sides, _force(entry, history, mesh))


def _force(entry: Entry, history: History, mesh: Mesh) -> Array | None:
    if entry.driven is None:
        return None
    name, reaction = entry.driven
    return np.asarray(history[reaction][:, mesh.node_sets[name] - 1].sum(axis=1))
