"""The gallery: models that a user would start from, and what is shown of each."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from harness.arrays import Array
from harness.models import convection, diffusion, indentation
from harness.models.document import Model
from harness.models.mesh import Mesh
from harness.models.parts import Control, Mixture
from harness.post import solute_balance
from harness.post.section_figures import Section
from harness.run.logdata import History
from harness.run.runner import RunResult
from studies.models import delamination, graft, joint, kept_models, platens, plug
from studies.models.indentation_variants import LEVELS


@dataclass(frozen=True)
class Entry:
    """A model of the gallery."""

    title: str
    start_here: str
    """For which model of one's own it is a start, and what to change."""
    model: Model
    """The one in models/."""
    small: Model
    """The same with fewer elements and steps, for the tests."""
    section: Section
    """The plane that is drawn."""
    times: tuple[float, ...]
    """Of the pictures, s."""
    driven: tuple[str, str] | None = None
    """Node set and reaction (Rx, Ry or Rz) whose sum is the force that is shown."""


@dataclass(frozen=True)
class Curves:
    """What is drawn over time, each of shape (n_times,)."""

    times: Array
    """s."""
    contents: dict[str, Array]
    """Solute in each porous part, nmol."""
    sides: dict[str, Array]
    """Mean effective concentration over the nodes of each contact surface whose material has the solute, mM."""
    force: Array | None
    """N, of the modelled part; compression is positive."""


UPRIGHT = Section(across=0, up=2)


def entries() -> tuple[Entry, ...]:
    """All models of the gallery: first the article's problems, then those from practice."""
    return (
        _diffusion(),
        _convection(),
        _indentation(),
        _joint(),
        _release(),
        _graft(),
        _platens(),
        _plug(),
        _delamination(),
    )


def _diffusion() -> Entry:
    return Entry(
        "Diffusion through two layers (problem 3.1)",
        "A solute diffuses from a solution through two tissues. Change layers, materials and concentration.",
        diffusion.Diffusion(plot=True).model(),
        diffusion.Diffusion(elements=5, control=Control(10, 200.0)).model(),
        UPRIGHT,
        (400.0, 2000.0, 8000.0),
    )


def _convection() -> Entry:
    return Entry(
        "Convection through two layers (problem 3.2)",
        "A pressure difference drives solvent and solute through two layers, to the steady state.",
        convection.Convection(plot=True).model(),
        convection.Convection(elements=5, control=Control(10, 500.0)).model(),
        UPRIGHT,
        (500.0, 2000.0, 20000.0),
    )


def _indentation() -> Entry:
    short = replace(indentation.CONTROL, steps=round(indentation.RAMP / indentation.CONTROL.step))
    return Entry(
        "A semi-cylinder driven into a slab (problem 3.3)",
        "Start here for indenters and condyles. The deformation is large, and the contact area grows. Open nodes have "
        "the ambient values.",
        kept_models.INDENTATION.model(),
        replace(kept_models.INDENTATION, plot=False, grid=LEVELS[0], control=short).model(),
        Section(mirrored=True),
        indentation.TIMES,
        ("top", "Ry"),
    )


def _joint() -> Entry:
    return Entry(
        "Cartilage on cartilage under cyclic load",
        "The layers of a joint take up solute from the synovial fluid. Change curvature, loading curve and solute.",
        kept_models.JOINT.model(),
        joint.Joint(cycles=1, across=10, through=4).model(),
        Section(mirrored=True),
        (20.0, 30.0, 190.0, 200.0),
        ("upper-bone", "Ry"),
    )


def _release() -> Entry:
    return Entry(
        "Cartilage on cartilage, a solute crosses",
        "A drug or a contrast agent passes from one layer into the other and into the synovial fluid.",
        kept_models.JOINT_RELEASE.model(),
        replace(kept_models.JOINT_RELEASE, plot=False, cycles=1, across=10, through=4).model(),
        Section(mirrored=True),
        (20.0, 30.0, 190.0, 200.0),
    )


def _graft() -> Entry:
    return Entry(
        "A graft in a defect, fed across its wall",
        "A press fit joins repair tissue and a host of different material, in three dimensions. Change both materials "
        "and the solution around them.",
        kept_models.GRAFT.model(),
        graft.Graft(around=2, outward=4, up=2, control=Control(5, 200.0)).model(),
        UPRIGHT,
        (50.0, 500.0, 1500.0, 3000.0),
    )


def _platens() -> Entry:
    return Entry(
        "A permeable platen against an impermeable one",
        "Start here for confined compression and permeation cells. One contact transmits traction, solvent and "
        "solute. The other transmits traction alone, because its platen is impermeable.",
        kept_models.PLATENS.model(),
        platens.Platens(elements=5, control=Control(10, 100.0)).model(),
        UPRIGHT,
        (100.0, 500.0, 3000.0),
        ("top", "Rz"),
    )


def _plug() -> Entry:
    return Entry(
        "An osteochondral plug on coarser bone",
        "A tie joins meshes that do not match, and a solute crosses it. Change meshes and materials.",
        kept_models.PLUG.model(),
        plug.Plug(around=(2, 1), up=(4, 2), control=Control(6, 1000.0)).model(),
        UPRIGHT,
        (500.0, 2000.0, 6000.0),
        ("top", "Rz"),
    )


def _delamination() -> Entry:
    short = replace(delamination.CONTROL, steps=30)
    return Entry(
        "Cartilage that delaminates under shear",
        "A cohesive tie breaks, and fluid enters the crack. Change strength, fracture energy and motion.",
        kept_models.DELAMINATION.model(),
        delamination.Delamination(along=(32, 16), up=(2, 1), control=short).model(),
        UPRIGHT,
        (20.0, 40.0, 60.0),
        ("layer-left", "Rx"),
    )


def curves(entry: Entry, result: RunResult) -> Curves:
    """What is shown of a run over time."""
    history, mesh = result.nodes, result.model.mesh
    states = solute_balance.states(history)
    porous = [part for part in mesh.parts if _has_solute(result.model, part.material)]
    wet = np.unique(np.concatenate([part.elements.ravel() for part in porous]))
    contents = {
        part.name: np.array([solute_balance.content(result.model, part, state) for state in states]) for part in porous
    }
    names = [name for pair in mesh.pairs.values() for name in pair]
    surfaces = {name: np.unique(mesh.surfaces[name]) for name in sorted(names, key=lambda name: _part(mesh, name))}
    sides = {name: history["c1"][:, ids - 1].mean(axis=1) for name, ids in surfaces.items() if np.isin(ids, wet).all()}
    return Curves(history.times, contents, sides, _force(entry, history, mesh))


def _part(mesh: Mesh, surface: str) -> int:
    """Which part a surface belongs to: surfaces are listed, and coloured, in the order of the parts."""
    return next(n for n, part in enumerate(mesh.parts) if np.isin(mesh.surfaces[surface], part.elements).all())


def _has_solute(model: Model, material: str) -> bool:
    return isinstance(model.materials[material], Mixture) and bool(model.materials[material].solutes)


def _force(entry: Entry, history: History, mesh: Mesh) -> Array | None:
    if entry.driven is None:
        return None
    name, reaction = entry.driven
    return np.asarray(history[reaction][:, mesh.node_sets[name] - 1].sum(axis=1))
