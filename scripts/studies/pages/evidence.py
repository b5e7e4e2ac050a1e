"""Pages of evidence: text without figures, and figures from stamped files alone.

A file of results below docs/data says what it was made with (`Stamp`), in its first line or under "stamp". A page has
its figures from such files, all with one stamp; its own text holds none.
"""

import json
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from harness.errors import DataFileError
from harness.paths import DOCS, REPOSITORY
from studies.stamps import Stamp

DATA = DOCS / "data"
WRITTEN = "<!-- Written by `scripts/mixcontact pages`: change {} instead. -->"
PLACE = re.compile(r"\{(\w+)\}")
_CODE = re.compile(r"```.*?```|`[^`]*`|<!--.*?-->|\]\([^)]*\)|https?://\S+", re.DOTALL)
_NAMES = re.compile(
    r"\bproblems? 3\.[1-4]\b(?: and 3\.[1-4]\b)?|\bFEBio 4\b"  # of problems and programs
    r"|\(\d{4}\)|\b\d+\(\d+\):\d+-\d+",  # years and places of articles
    re.IGNORECASE,
)
_FIGURE = re.compile(r"\d")


@dataclass(frozen=True)
class EvidencePage:
    """A page of evidence."""

    name: str  # below docs/
    sources: tuple[str, ...]  # files below docs/data that its figures come from
    template: Path
    """Markdown with a place ``{name}`` for each figure, table or list; ``{stamp}`` says what they were made with."""
    figures: Callable[[], Mapping[str, str]]  # reads the sources and says what goes where
    compares_sources: bool = True
    """Whether the same commit of the plugin has to have made all sources; False where each has tables of its own."""

    def __call__(self) -> str:
        """The page. Raises DataFileError where sources have different stamps, or its text holds a figure of its own."""
        text = self.template.read_text(encoding="utf-8")
        own = figures_in(text)
        if own:
            raise DataFileError(f"{self.template}: a figure that stands in no file of results: {own}")
        stamp = one_stamp([DATA / source for source in self.sources], any_commit=not self.compares_sources)
        places = {"written": WRITTEN.format(self.template.relative_to(REPOSITORY)), "stamp": str(stamp)}
        return filled(text, {**places, **self.figures()})

    def write(self) -> Path:
        """Write the page, and return its path."""
        path = DOCS / self.name
        path.write_text(self(), encoding="utf-8")
        return path


def filled(text: str, figures: Mapping[str, str]) -> str:
    """A template with its places filled in; braces in code stay.

    Raises DataFileError where a place has no figure, or a figure no place.
    """
    places = set(PLACE.findall(text))
    if places != set(figures):
        raise DataFileError(f"places and figures do not agree on {', '.join(sorted(places ^ set(figures)))}")
    return PLACE.sub(lambda place: figures[place[1]], text)


def figures_in(text: str) -> str:
    """The first line of a text that holds a figure: a digit outside code, links and names."""
    bare = _NAMES.sub("", _CODE.sub("", PLACE.sub("", text)))
    return next((line.strip() for line in bare.splitlines() if _FIGURE.search(line)), "")


def stamp_of(path: Path) -> Stamp:
    """What a file of results was made with. Raises DataFileError for a file without a stamp."""
    try:
        text = path.read_text(encoding="utf-8")
        data = json.loads(text)["stamp"] if path.suffix == ".json" else json.loads(text.splitlines()[0].lstrip("# "))
        return Stamp(**data)
    except (OSError, ValueError, KeyError, TypeError, IndexError) as error:
        raise DataFileError(f"{path} says not what it was made with ({error})") from error


def check_together(limits: Mapping[str, float]) -> None:
    """Refuse results that were not measured in one go.

    limits: by the names of files below docs/data, the limit (s) that each must have.
    Raises DataFileError where plugin, commit or FEBio differ, or a limit is another one.
    """
    found = {name: stamp_of(DATA / name) for name in limits}
    versions = {(stamp.plugin, stamp.commit, stamp.engine) for stamp in found.values()}
    if len(versions) != 1 or any(stamp.limit != limits[name] for name, stamp in found.items()):
        told = "; ".join(f"{name}: {stamp}" for name, stamp in found.items())
        raise DataFileError(f"results were not measured in one go, which `evidence` does: {told}")


def one_stamp(paths: list[Path], *, any_commit: bool = False) -> Stamp:
    """The stamp that files have in common; with `any_commit`, different commits of the plugin may have made them.

    Raises DataFileError where they differ.
    """
    found = {path: stamp_of(path) for path in paths}
    if len({str(stamp) if any_commit else stamp for stamp in found.values()}) != 1:
        told = "; ".join(f"{path.name}: {stamp}" for path, stamp in found.items())
        raise DataFileError(f"results of one page were made with different things: {told}")
    return next(iter(found.values()))
