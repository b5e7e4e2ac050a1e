"""The page of the hard cases: docs/evidence/hard-cases.md, from docs/data/hard-cases.csv."""

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from studies import files, tables
from studies.hard_cases import outcomes
from studies.hard_cases.catalogue import CASES
from studies.hard_cases.outcomes import Outcome
from studies.hard_cases.scene import Fineness, Interface
from studies.pages.evidence import DATA, EvidencePage

SOURCE, PICTURE = "hard-cases.csv", "images/hard-cases.svg"
ABOUT = {name: case.about for name, case in CASES.items()}  # what each case is about


def figures() -> Mapping[str, str]:
    """What the text of the page leaves open."""
    found = files.read_csv(DATA / SOURCE, Outcome)
    return {
        "headline": _headline(found),
        "details": _details(found),
        "summary": outcomes.summary(found),
        "not_run": _not_run(found),
        "better": _better(found, ABOUT),
    }


def _headline(found: list[Outcome]) -> str:
    ours = [outcome for outcome in found if outcome.interface == outcomes.OURS]
    accurate = [outcome for outcome in found if outcome.interface == outcomes.FEBIO[-1]]
    mine, theirs = (sum(not outcome.missed and outcome.ended for outcome in own) for own in (ours, accurate))
    return (
        f"`sliding-mixture` passes all checks in {mine} of {len(ours)} hard cases. FEBio's interface passes all in "
        f"{theirs} at about the same accuracy."
    )


def _details(found: list[Outcome]) -> str:
    accurate = [outcome for outcome in found if outcome.interface == outcomes.FEBIO[-1]]
    ours = [outcome for outcome in found if outcome.interface == outcomes.OURS]
    cases = list(dict.fromkeys(outcome.case for outcome in ours))
    meshes = " and ".join(dict.fromkeys(outcome.mesh for outcome in ours))
    return (
        f"These {len(cases)} cases have conditions in which contact is known to fail. All ran on the {meshes} mesh. "
        f"`sliding-mixture` completes {_completed(ours)} of {len(ours)} runs. FEBio's interface completes "
        f"{_completed(accurate)} of {len(accurate)} and misses checks in {len(_missing(accurate))}. "
        f"{technical(accurate)} {counted_twice(cases)}"
    )


def _completed(runs: Sequence[Outcome]) -> int:
    return sum(run.ended for run in runs)


def _missing(runs: Sequence[Outcome]) -> list[Outcome]:
    return [run for run in runs if run.end is outcomes.End.MISSES]


SLIGHT = 1e-6  # a relative difference below this says nothing of a solution
_FURTHER = "a further run that a check needs"
_PRINTED = re.compile(r"(\S+) \(tolerance ([^,)]+)[,)]")
"""Value and tolerance of a check that is missed, as the data have them."""


def technical(runs: Sequence[Outcome]) -> str:
    """How many runs that end miss checks for reasons that say nothing, or next to nothing, against their solution."""
    missing = _missing(runs)
    further = sum(run.missed.startswith(_FURTHER) for run in missing)
    printed = [_PRINTED.findall(run.missed) for run in missing if not run.missed.startswith(_FURTHER)]
    rounding = sum(all(float(value) < SLIGHT for value, _ in found) for found in printed)
    close = sum(all(value == tolerance for value, tolerance in found) for found in printed)
    return (
        f"The missed difference is below {SLIGHT:g} in {rounding} of these {len(missing)}. Value and tolerance agree "
        f"in the printed digits in {close}. A further run for the check failed or could not be compared in {further}."
    )


def counted_twice(cases: Sequence[str]) -> str:
    """Which cases are one scene: the same model with another check, or with two passes."""
    told = tables.grouped(cases, _scene)
    groups = [names for names in told.values() if len(names) > 1]
    named = "; ".join(" and ".join(f"`{name}`" for name in names) for names in groups)
    return f"Some cases share a scene: {named}. The {len(cases)} cases have {len(told)} scenes." if groups else ""


def _scene(name: str) -> str:
    """The model of a case without its name and its number of passes."""
    model = CASES[name].scene.model(Fineness.COARSE, Interface.FEBIO_1000)
    text = re.sub(r"<!--.*?-->|<two_pass>1</two_pass>|\s+", "", model.text(), flags=re.DOTALL)
    return text.replace(model.name, "")


def _not_run(found: list[Outcome]) -> str:
    """The meshes, and the scenes of the catalogue, that the data do not have."""
    meshes = {outcome.mesh for outcome in found}
    missing = [f"the {mesh.value} mesh" for mesh in Fineness if mesh.value not in meshes]
    cases = {outcome.case for outcome in found}
    missing += [case.about for name, case in CASES.items() if name not in cases]
    return f"The data do not include {'; '.join(missing)}." if missing else "The data have all scenes on both meshes."


def _better(found: list[Outcome], about: Mapping[str, str]) -> str:
    """The scenes in which a run of FEBio's passes with less, or ours falls short."""
    lines = []
    for (case, mesh), row in outcomes.arranged(found).items():
        runs = outcomes.better(row)
        if runs:
            theirs = " and ".join(f"{run.short} ({run.interface.replace('febio-', 'factor ')})" for run in runs)
            lines.append((about[case], mesh, theirs, row[outcomes.OURS].short))
    shorter = "passes with fewer iterations, or fewer repeated steps, than `sliding-mixture`"
    if not lines:
        return f"No run with FEBio's interface {shorter}."
    counts = tables.markdown(("case", "mesh", "FEBio's interface", "`sliding-mixture`"), lines)
    return f"A run with FEBio's interface {shorter} in {len(lines)} of these cases:\n\n{counts}"


PAGE = EvidencePage("evidence/hard-cases.md", (SOURCE,), Path(__file__).with_name("page.md"), figures)
