"""The page of the hard cases: docs/evidence/hard-cases.md, from docs/data/hard-cases.csv."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from harness.pages.evidence import DATA, EvidencePage
from harness.studies import files
from harness.studies.hard_cases import outcomes
from harness.studies.hard_cases.catalogue import CASES
from harness.studies.hard_cases.outcomes import Outcome
from harness.studies.hard_cases.scene import Fineness

SOURCE, PICTURE = "hard-cases.csv", "images/hard-cases.svg"


def figures() -> Mapping[str, str]:
    """What the text of the page leaves open."""
    found = files.read_csv(DATA / SOURCE, Outcome)
    about = {name: case.about for name, case in CASES.items()}
    return {
        "headline": _headline(found),
        "summary": outcomes.summary(found),
        "not_run": _not_run(found),
        "better": _better(found, about),
        "table": outcomes.table(found, about),
    }


def _headline(found: list[Outcome]) -> str:
    ours = [outcome for outcome in found if outcome.interface == outcomes.OURS]
    accurate = [outcome for outcome in found if outcome.interface == outcomes.FEBIO[-1]]
    scenes = len({outcome.case for outcome in ours})
    meshes = " and ".join(dict.fromkeys(outcome.mesh for outcome in ours))
    mine, theirs = (sum(not outcome.missed and outcome.ended for outcome in own) for own in (ours, accurate))
    return (
        f"**Of {len(ours)} runs of {scenes} scenes in which contact is known to fail ({meshes} mesh), "
        f"`sliding-mixture` ends {sum(outcome.ended for outcome in ours)} and passes all checks in {mine}; FEBio's "
        f"interface at about the same accuracy ends {sum(outcome.ended for outcome in accurate)} and passes all checks "
        f"in {theirs}.**"
    )


def _not_run(found: list[Outcome]) -> str:
    """The meshes, and the scenes of the catalogue, that the data do not have."""
    meshes = {outcome.mesh for outcome in found}
    missing = [f"the {mesh.value} mesh" for mesh in Fineness if mesh.value not in meshes]
    cases = {outcome.case for outcome in found}
    missing += [case.about for name, case in CASES.items() if name not in cases]
    return f"Not in these data: {'; '.join(missing)}." if missing else "These are all scenes on both meshes."


def _better(found: list[Outcome], about: Mapping[str, str]) -> str:
    """The scenes in which a run of FEBio's passes with less, or ours falls short."""
    lines = []
    for (case, mesh), row in outcomes.arranged(found).items():
        runs = outcomes.better(row)
        if runs:
            told = " and ".join(f"{run.short} with {run.interface.replace('febio-', 'factor ')}" for run in runs)
            lines.append(f"- {about[case]}, {mesh} mesh: {told}, `sliding-mixture` {row[outcomes.OURS].short}")
    shorter = "passes with fewer iterations, or fewer steps tried again, than `sliding-mixture`"
    head = f"In {len(lines)} of these scenes a run with FEBio's interface {shorter}:" if lines else ""
    return "\n\n".join(filter(None, [head, "\n".join(lines)])) or f"In none of these scenes a run of FEBio's {shorter}."


PAGE = EvidencePage("evidence/hard-cases.md", (SOURCE,), Path(__file__).with_name("page.md"), figures)
