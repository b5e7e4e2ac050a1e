"""The steps that measure everything in docs/data, in the order in which they are done."""

from dataclasses import dataclass
from pathlib import Path

from harness.errors import DataFileError
from harness.paths import DOCS
from studies.knees.page import LIMIT as KNEE_LIMIT
from studies.pages import evidence
from studies.stamps import LIMIT

Command = tuple[str, ...]  # arguments of the harness


@dataclass(frozen=True)
class Step:
    """A part of the evidence that is measured by itself."""

    name: str
    files: tuple[str, ...]  # below docs/data, that it writes
    commands: tuple[Command, ...]  # done one after the other; ``{folder}`` stands for a folder for what they leave
    limit: float = LIMIT  # s of processor time for a run, which the stamps of its files say; 0 without a limit
    alone: bool = False
    """Whether its pages say themselves what its files were made with, which may be another commit than that of the
    files that are measured in one go."""

    def is_done(self, commit: str) -> bool:
        """Whether its files are there and were made with this commit of the plugin and its limit."""
        try:
            stamps = [evidence.stamp_of(evidence.DATA / name) for name in self.files]
        except DataFileError:
            return False
        return bool(stamps) and all((stamp.commit, stamp.limit) == (commit, self.limit) for stamp in stamps)

    def commands_in(self, folder: Path) -> list[Command]:
        """Its commands, with a folder of their own below `folder`."""
        return [tuple(part.format(folder=folder / self.name) for part in command) for command in self.commands]


_DOCS = ("--folder", str(DOCS))
_ON_THE_PAGE = ("--only", "joints", "--only", "effects", "--only", "comparison")  # of prices
UNTIMED = (
    Step("verification", ("verification.json",), (("validate", "--jobs", "2"), ("verification-report",)), 0.0),
    Step(
        "linear-solvers",
        ("linear-solvers.json",),
        (("linear-solvers", "--data", str(DOCS / "data" / "linear-solvers.json")),),
        0.0,
    ),
    Step("biphasic-hertz", ("biphasic-hertz.csv",), (("biphasic-hertz", *_DOCS),), 0.0),
    Step("elastic-hertz", ("elastic-hertz.csv",), (("elastic-hertz", *_DOCS),), 0.0),
    Step(
        "hard-cases",
        ("hard-cases.csv",),
        (("hard-cases", "--mesh", "coarse", "--docs", "--jobs", "2", "--folder", "{folder}"),),
    ),
    Step(
        "synthetic-scenes",
        ("synthetic-scenes.json",),
        (("synthetic-scenes", "--docs", "--jobs", "2", "--folder", "{folder}"),),
    ),
    Step(
        "reported-scenes",
        ("reported-scenes.json",),
        (("synthetic-scenes", "--collection", "reported", "--docs", "--jobs", "2", "--folder", "{folder}"),),
        alone=True,
    ),
    Step("knee", ("knee.csv",), (("knee", "--docs", "--folder", "{folder}"),), KNEE_LIMIT, alone=True),
    Step("ablation", ("ablation.csv",), (("ablation", "--docs", "--folder", "{folder}"),), alone=True),
    Step("agreement", ("agreement.json",), (("agreement", "--docs", "--folder", "{folder}"),), alone=True),
    Step(
        "friction-cases", ("friction-cases.csv",), (("friction-cases", "--docs", "--no-febio", "--folder", "{folder}"),)
    ),
    Step("friction-benchmarks", ("friction-benchmarks.csv",), (("friction-benchmarks", *_DOCS),), alone=True),
)
"""Times do not count in these, so that two runs may go on at a time."""
TIMED = (
    Step("gallery", ("gallery.json",), (("gallery", *_DOCS),), 0.0, alone=True),
    Step("friction-cost", ("friction-cost.csv",), (("friction-cost", *_DOCS),), alone=True),
    Step("cost", ("cost.csv",), (("cost", "--docs", "--folder", "{folder}"),), alone=True),
    Step(
        "price",
        ("price-joints.csv", "price-effects.csv", "price-comparison.csv"),
        (("price", *_ON_THE_PAGE, "--docs", "--folder", "{folder}"),),
        alone=True,
    ),
    Step(
        "price-matrices",
        ("price-matrices.csv",),
        (("price", "--only", "matrices", "--docs", "--folder", "{folder}"),),
        alone=True,
    ),
)
"""Nothing else runs beside these."""
PAGES = Step("pages", (), (("pages",),), 0.0)  # what is written from all files
STEPS = (*UNTIMED, *TIMED, PAGES)
LIMITS = {name: step.limit for step in STEPS for name in step.files if not step.alone}
"""By the files below docs/data that are measured in one go, the limit that their stamps must say."""
ALONE = {name: step.limit for step in STEPS for name in step.files if step.alone}  # the same of the other files
