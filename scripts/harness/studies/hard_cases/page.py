"""The page of the hard cases: docs/evidence/hard-cases.md, from docs/data/hard-cases.csv."""

from __future__ import annotations

from collections.abc import Mapping

from harness.pages.evidence import DATA, EvidencePage
from harness.studies import files
from harness.studies.hard_cases import outcomes
from harness.studies.hard_cases.catalogue import CASES
from harness.studies.hard_cases.outcomes import Outcome

SOURCE, PICTURE = "hard-cases.csv", "images/hard-cases.svg"

TEXT = """\
# Hard cases

<!-- Written by `scripts/mixcontact pages`: change scripts/harness/studies/hard_cases/page.py instead. -->

{headline}

![Scenes in which contact is known to fail, one row each, by interface: iterations, or the part of the time reached](../images/hard-cases.svg)

A number is that of Newton iterations, with the steps tried again in brackets. Of a run that did not end it is the part
of the scene's time that was reached. Data: [hard-cases.csv](../data/hard-cases.csv).

Made with {stamp}. The limit is the same for all interfaces and counts processor time, so that other work on the machine
makes no difference.

{summary}

FEBio's interface is `sliding-multiphasic` with its non-symmetric tangent and `auto_penalty`. The factor on its
penalties is one (it runs most easily so) or a thousand (about as accurate as the default of `sliding-mixture`).
Negative concentrations are not clamped. The predictor is off by default; [what it does](../explanation/predictor.md).

## What is checked

| check | of |
|---|---|
| the physical check of the scene: a closed form, the conforming reference, symmetry, the same run in other units, restarted, in many steps | all |
| node data are numbers; concentrations stay within what is given, but for the undershoot of linear elements at a front | all |
| solute that appears where nothing feeds it | all |
| no tension; overlap; load across a gap: means over facets, at each accepted step | all |
| open primary nodes have the ambient values exactly; forces and flows of the two sides cancel | `sliding-mixture` |
| the model turned, shifted and renumbered; primary and secondary surface exchanged | `sliding-mixture` without predictor |

FEBio's logs hold no flows, so that the last two rows cannot be asked of its interfaces. Tolerances stand in
`scripts/harness/studies/hard_cases`, with their reasons.

## Where FEBio's interface is better

{better}

## Again

```console
scripts/mixcontact hard-cases --docs
scripts/mixcontact hard-cases --only edge-on-face
scripts/mixcontact hard-case edge-on-face coarse
```

The first runs all of them and writes data, picture and this page; it goes on where it was interrupted. The second is
for one scene, the third for one run with each check and its tolerance. Snakemake drives the runs and is installed on
first use. What follows `--` goes to it: `-- --executor slurm` uses a cluster.

Random scenes and random parameters, from seeds, for as long as one likes:

```console
scripts/mixcontact fuzz --minutes 60 --seed 0
```

## Friction

```console
scripts/mixcontact friction-cases
scripts/mixcontact friction-cases --only reversal --mesh coarse --no-febio
```

run scenes with friction (`scripts/harness/studies/hard_cases/rubbing.py`), without it, and with friction of FEBio's
`sliding-multiphasic`, and check balances, iterations and retries.

## All runs

{table}
"""


def figures() -> Mapping[str, str]:
    """What the text of the page leaves open."""
    found = files.read_csv(DATA / SOURCE, Outcome)
    about = {name: case.about for name, case in CASES.items()}
    return {
        "headline": _headline(found),
        "summary": outcomes.summary(found),
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
        f"**Of {len(ours)} runs of {scenes} scenes in which contact is known to fail ({meshes} mesh), `sliding-mixture` "
        f"ends {sum(outcome.ended for outcome in ours)} and passes all checks in {mine}; FEBio's interface at about the "
        f"same accuracy ends {sum(outcome.ended for outcome in accurate)} and passes all checks in {theirs}.**"
    )


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


PAGE = EvidencePage("evidence/hard-cases.md", (SOURCE,), TEXT, figures)
