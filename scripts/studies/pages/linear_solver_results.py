"""The page of the linear solvers, from measured trials alone."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

from studies import files, tables
from studies.files import Stamped
from studies.pages.texts import page_text

PAGE = "reference/linear-solvers.md"
DATA = Path("data", "linear-solvers.json")  # below docs/
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
    """A run."""

    # What was solved by what.
    scene: str
    solver: str
    preconditioner: str
    enforcement: str
    outcome: str  # how it ended
    difference: float  # of the last state from that of the reference, relative to the largest value of each kind
    febio: str  # the FEBio that ran it
    commit: str  # of the plugin's sources, or unknown

    @property
    def cell(self) -> tuple[str, str, str, str]:
        """Where it stands in the table."""
        return (self.scene, self.enforcement, self.solver, self.preconditioner)


Results = Stamped[Trial]  # the stamp is that of the last trials; others say their own FEBio and commit
HEAD = page_text("linear-solvers")


def read(path: Path) -> Results:
    """Read what the command wrote, as `files.read_stamped` does."""
    return files.read_stamped(path, Trial, "linear-solvers")


def renewed(known: Sequence[Trial], made: Sequence[Trial]) -> list[Trial]:
    """The newer of two trials of the same cell; the older one where the newer FEBio lacks the solver."""
    old = {trial.cell: trial for trial in known}
    new = {t.cell: t for t in made if t.outcome != Outcome.UNAVAILABLE or t.cell not in old}
    return list((old | new).values())


def page(results: Results) -> str:
    """The text of the page."""
    trials = results.rows
    largest = max(trial.difference for trial in trials if trial.outcome == Outcome.SOLVED)
    return HEAD.format(largest=f"{largest:.0e}", engines=_engines(results), table=table(trials))


def table(trials: Sequence[Trial]) -> str:
    """A row for each solver, a column for each scene and enforcement."""
    columns = [(scene, enforcement) for scene in SCENES for enforcement in ENFORCEMENTS]
    heads = ["`<linear_solver>`, `<pc_left>`", *(f"{scene}: `{enforcement}`" for scene, enforcement in columns)]
    found = {trial.cell: trial.outcome for trial in trials}
    rows = [
        [solver.name, *(found.get((*column, solver.type, solver.preconditioner), "not measured") for column in columns)]
        for solver in SOLVERS
    ]
    return tables.markdown(heads, rows)


def _engines(results: Results) -> str:
    """What measured the rows: the stamp, and what differs from it."""
    others: dict[tuple[str, str], dict[str, None]] = {}
    for trial in results.rows:
        if (trial.febio, trial.commit) != (results.stamp.engine, results.stamp.commit):
            others.setdefault((trial.febio, trial.commit), {})[Solver(trial.solver).name] = None
    plugins = {commit: f"plugin at commit {commit}" for _, commit in others} | {"unknown": "an earlier plugin"}
    told = [f"{', '.join(names)} with {febio}, {plugins[commit]}" for (febio, commit), names in others.items()]
    return f"The runs used {results.stamp}." + (f" Some rows used other programs: {'; '.join(told)}." if told else "")
