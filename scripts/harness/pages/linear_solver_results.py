"""The page of the linear solvers, from measured trials alone."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

PAGE = "reference/linear-solvers.md"
DATA = Path("data", "linear-solvers.json")
"""Below docs/."""
SCENES = ("diffusion", "creep")

ENFORCEMENTS = ("PENALTY", "AUGLAG", "LAGMULT")


@dataclass(frozen=True)
class Solver:
    """A linear solver of FEBio's, and its preconditioner where it has one."""

    type: str
    preconditioner: str = ""

    @property
    def name(self) -> str:
        """As the table has it."""
        return f"`{self.type}`" + (f", `{self.preconditioner}`" if self.preconditioner else "")


SOLVERS = (
    Solver("pardiso"),
    Solver("mkl_dss"),
    Solver("superlu_mt"),
    Solver("fgmres"),
    Solver("fgmres", "ilu0"),
    Solver("fgmres", "ilut"),
    Solver("bicgstab"),
    Solver("bicgstab", "ilu0"),
    Solver("bicgstab", "ilut"),
    Solver("hypre_gmres"),
    Solver("skyline"),
)


class Outcome(str, Enum):
    """How a run ended."""

    SOLVED = "yes"
    OTHER_RESULT = "no: another result"
    SYMMETRIC_ONLY = "no: symmetric matrices only"
    NO_SOLUTION = "no: finds no solution"
    NOT_CONVERGED = "no: does not converge"
    UNAVAILABLE = "not in the build at hand"


@dataclass(frozen=True)
class Trial:
    """A run: what was solved by what, how it ended, and how far its last state is from the reference."""

    scene: str
    solver: str
    preconditioner: str
    enforcement: str
    outcome: str
    difference: float
    febio: str


HEAD = """\
# Linear solvers

<!-- Written by `scripts/mixcontact pages` from data/linear-solvers.json, which `linear-solvers` measures. -->

The matrix of the contact is non-symmetric, and with `LAGMULT` it has zeros on its diagonal. `pardiso`, FEBio's default,
and `mkl_dss` solve every model here. Both are part of MKL. An FEBio without MKL has `skyline` as its default, which
cannot; give `superlu_mt` there, in the model or as the default in `febio.xml`.

Each cell is a run of a small model: diffusion between two cubes of 3 elements (3.1), and confined creep of a biphasic
layer. `yes`: the run ends normally, with the values of `pardiso` to {largest} of the largest of each kind. {engines}

{table}

Multipliers put zeros on the diagonal, on which incomplete factorisations divide: use a direct solver with `LAGMULT`.
Whether `ilu0` or `ilut` solves a model with multipliers depends on rounding, and differs between machines; the cells
say what one machine found.
The log and `scripts/mixcontact check` warn of a solver for symmetric matrices and of an iterative one with `LAGMULT`.
FEBio's message is "Linear solver failed to find solution" where a solver fails, and "The selected linear solver does
not support the requested matrix format" where it is for symmetric matrices or was not built in.
`hypre_gmres` reports no failure: Newton's method does not converge then.

```console
scripts/mixcontact linear-solvers --only pardiso
```

measures the rows of one solver with the FEBio that is found; without `--only` all of them.
"""


def read(path: Path) -> list[Trial]:
    """The measured trials."""
    return [Trial(**entry) for entry in json.loads(path.read_text(encoding="utf-8"))]


def page(trials: Sequence[Trial]) -> str:
    """The text of the page."""
    largest = max(trial.difference for trial in trials if trial.outcome == Outcome.SOLVED)
    return HEAD.format(largest=f"{largest:.0e}", engines=_engines(trials), table=table(trials))


def table(trials: Sequence[Trial]) -> str:
    """A row for each solver, a column for each scene and enforcement."""
    columns = [(scene, enforcement) for scene in SCENES for enforcement in ENFORCEMENTS]
    heads = ["`<linear_solver>`, `<pc_left>`", *(f"{scene}: `{enforcement}`" for scene, enforcement in columns)]
    found = {(t.solver, t.preconditioner, t.scene, t.enforcement): t.outcome for t in trials}
    rows = [
        [solver.name, *(found.get((solver.type, solver.preconditioner, *column), "not measured") for column in columns)]
        for solver in SOLVERS
    ]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in (heads, ["---"] * len(heads), *rows))


def _engines(trials: Sequence[Trial]) -> str:
    """What measured which rows."""
    by_engine: dict[str, list[str]] = {}
    for trial in trials:
        names = by_engine.setdefault(trial.febio, [])
        name = Solver(trial.solver).name
        if name not in names:
            names.append(name)
    if len(by_engine) == 1:
        return f"Measured with {trials[0].febio}, one thread."
    said = "; ".join(f"{', '.join(names)} with {engine}" for engine, names in by_engine.items())
    return f"Measured with one thread: {said}."
