"""Variations of the two confined blocks that are checked against another run instead of, or beside, the closed form."""

import shutil
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from harness.post import compare
from harness.post.compare import Measure
from harness.preflight.penalty import TRACTION_FACTOR
from harness.run import engine, logdata
from harness.run.runner import Runner, RunResult
from studies.hard_cases import variants
from studies.hard_cases.invariants import INVARIANT
from studies.hard_cases.press import Press
from studies.hard_cases.scene import NEWTON, Interface

SETTLED = 500  # steps of `Steady` after which nothing moves
SPLIT = NEWTON  # largest difference of the split body from its reference, relative to the largest value of a variable


@dataclass(frozen=True)
class AgainstReference(Press):
    """Where convection leaves no simple closed form: the split body against the conforming reference."""

    transient: bool = True  # whether all times are compared, or the steady state alone

    def check(self, run: RunResult, rerun: Runner) -> list[Measure]:
        """Pressure and concentrations at all nodes."""
        reference = rerun(self.reference(self.fineness(run)))
        measures = []
        for name in ("p", *(f"c{k + 1}" for k in range(run.model.n_solutes))):
            gaps = compare.differences(run, reference, name)
            gap = float((gaps if self.transient else gaps[-1:]).max()) / float(np.abs(reference.nodes[name]).max())
            measures.append(Measure(f"{name}, split against conforming, relative", gap, SPLIT))
        return measures


@dataclass(frozen=True)
class Soft(Press):
    """Penalties as small as the stiffness of the elements beside the contact, which gives way like a third body."""

    def check(self, run: RunResult, rerun: Runner) -> list[Measure]:
        """The closed form of the blocks, shortened by what the overlap leaves, and the overlap: traction/penalty.

        Jumps of concentration are left to `tolerance`.
        """
        facets = run.facets("lower-top")  # of one size; FEBio counts an overlap as positive
        load, overlap = facets["contact pressure"].mean(axis=1), facets["contact gap"].mean(axis=1)
        left = replace(self, shortening=self.shortening - float(overlap[-1]))
        force, *concentrations = super(Soft, left).check(run, rerun)
        measures = [replace(force, tolerance=Press.tolerance), *concentrations]
        if run.model.contacts[0].kind == Interface.MIXTURE.value:
            error = float(np.abs(load - self._penalty(run) * overlap).max() / load.max())
            measures.append(Measure("mean traction, penalty times mean overlap, relative difference", error, INVARIANT))
        return measures

    def _penalty(self, run: RunResult) -> float:
        """The penalty (MPa/mm) of blocks of 1 mm and one isotropic material: a factor on 2 k1 k2/(k1 + k2), k = E/h."""
        one, two = (self.lower.solid.modulus * elements[2] for elements in self._elements(self.fineness(run)))
        return self.penalties * TRACTION_FACTOR * 2.0 * one * two / (one + two)


@dataclass(frozen=True)
class InOtherUnits(Press):
    """The same model in m, N, s and in um, nN, s."""

    def check(self, run: RunResult, rerun: Runner) -> list[Measure]:
        """All node data, converted back."""
        measures = super().check(run, rerun)
        for units in variants.UNITS:
            other = rerun(variants.in_units(run.model, units)).nodes
            converted = variants.from_units(other.values, run.model.node_columns, units)
            gap = variants.difference(run, converted, other.times)
            measures.append(Measure(f"in {units.name}, relative difference", gap, INVARIANT))
        return measures


@dataclass(frozen=True)
class Restarted(Press):
    """A run that is continued from the dump file of the middle of its way."""

    def check(self, run: RunResult, rerun: Runner) -> list[Measure]:
        """The states after the restart against those of the run that went through."""
        # febio4 ends with a segmentation fault where a restarted model logs data of surfaces or facets.
        bare = replace(run.model, surface_columns=(), facet_columns=())
        model = replace(bare, name=f"{run.model.name}-dump", plot=True)
        half = 3 * len(self.times) // 5  # FEBio overwrites the file: once only
        dumped = rerun(model, options=("-dump=1", f"-dump_stride={half}"))
        with TemporaryDirectory() as scratch:
            folder = shutil.copytree(dumped.folder, Path(scratch) / "continued")
            (folder / model.node_file).unlink()
            needs = any(contact.kind == Interface.MIXTURE.value for contact in model.contacts)
            load = ["-import", str(engine.required_plugin())] if needs else []
            command = [str(engine.find_engine()), "-r", f"{model.name}.dmp", *load]
            engine.execute(command, folder, timeout=rerun.timeout)
            part = logdata.read_history(folder / model.node_file, model.node_columns)
        gap = variants.difference(run, part.values[-1:], part.times[-1:])
        return [*super().check(run, rerun), Measure("restarted, relative difference", gap, INVARIANT)]


@dataclass(frozen=True)
class Steady(Press):
    """Many steps at a constant state."""

    def check(self, run: RunResult, rerun: Runner) -> list[Measure]:
        """Whatever moves after the first `SETTLED` steps, relative to the largest value of each variable."""
        early = slice(SETTLED, SETTLED + 1)
        change = variants.difference(run, run.nodes.values[early], run.nodes.times[early])
        return [*super().check(run, rerun), Measure("change at constant state, relative", change, INVARIANT)]


@dataclass(frozen=True)
class CutBack(Press):
    """A time step that cannot converge at the moment of first touch."""

    def check(self, run: RunResult, rerun: Runner) -> list[Measure]:
        """The closed form, and that the step was cut back at all."""
        forced = Measure("steps tried again", run.report.retries, 8.0, lowest=1.0)
        return [*super().check(run, rerun), forced]


def spiked(touch: float, end: float) -> tuple[tuple[float, float], ...]:
    """A path from 0 to 1 over `end` s that is out of reach at the time `touch` (s) alone."""
    near = 0.01 * touch
    before, after = (touch - near) / end, (touch + near) / end
    return ((0.0, 0.0), (touch - near, before), (touch, 30.0), (touch + near, after), (end, 1.0))
