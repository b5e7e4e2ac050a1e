"""The commands that run the hard cases: all of them, and a single one."""

from itertools import product
from pathlib import Path
from typing import Annotated

import typer

from harness.choice import chosen
from harness.paths import DOCS, RESULTS
from harness.run.runner import Runner
from studies import files, stamps, workflow
from studies.hard_cases import heat_map, outcomes, page, record
from studies.hard_cases.catalogue import CASES
from studies.hard_cases.outcomes import End, Outcome
from studies.hard_cases.record import Record
from studies.hard_cases.scene import Fineness, Interface
from studies.options import TWO_AT_MOST, Docs, Folder, Jobs, Limit, Snakemake, console
from studies.pages.evidence import DATA
from studies.stamps import LIMIT, Stamp


def hard_cases(
    only: Annotated[list[str] | None, typer.Option(help="Run only this case. The option may be repeated.")] = None,
    mesh: Annotated[list[Fineness] | None, typer.Option(help="Run only this mesh.")] = None,
    interface: Annotated[list[Interface] | None, typer.Option(help="Run only this interface.")] = None,
    folder: Folder = RESULTS / "hard-cases",
    jobs: Jobs = TWO_AT_MOST,
    limit: Limit = LIMIT,
    docs: Docs = False,
    snakemake: Snakemake = None,
) -> None:
    """Run the hard cases on two meshes with sliding-mixture and FEBio's interfaces, and write the table.

    The command keeps completed runs. The exit code is 0 if sliding-mixture completes all runs and passes all checks.
    """
    wanted = {
        f"{case}-{made.value}-{each.value}": (
            *("hard-case", case, made.value),
            *("--interface", each.value, "--limit", str(limit)),
        )
        for made, case, each in product(mesh or Fineness, chosen(only, CASES), interface or Interface)
    }
    paths = workflow.run(wanted, folder.resolve(), cores=jobs, options=snakemake or ())
    found = [entry.outcome for path in paths for entry in record.read(path)]
    _write(found, stamps.stamp(limit), folder)
    complete = len(paths) == len(wanted)
    if docs and complete:
        _write_docs(found, stamps.stamp(limit))
    own = [outcome for outcome in found if outcome.interface == Interface.MIXTURE.value]
    if not complete or not all(outcome.end is End.PASSES for outcome in own):
        raise typer.Exit(1)


def _write(found: list[Outcome], stamp: Stamp, folder: Path) -> None:
    about = {name: case.about for name, case in CASES.items()}
    text = f"{stamp}\n\n{outcomes.summary(found)}\n\n{outcomes.table(found, about)}\n"
    console.print(text, markup=False)
    (folder / "hard-cases.md").write_text(text)
    files.write_csv(found, Outcome, folder / "hard-cases.csv", stamp)
    console.print(f"Written: {folder / 'hard-cases.md'}, {folder / 'hard-cases.csv'}")


def _write_docs(found: list[Outcome], stamp: Stamp) -> None:
    files.write_csv(found, Outcome, DATA / page.SOURCE, stamp)
    heat_map.draw(found, DOCS / page.PICTURE)
    console.print(f"Written: {page.PAGE.write()}")


def hard_case(
    name: Annotated[str, typer.Argument(help="Name of the case.")],
    mesh: Annotated[Fineness, typer.Argument(help="Name of the mesh.")] = Fineness.COARSE,
    interface: Annotated[
        list[Interface] | None, typer.Option(help="Run only this interface. The option may be repeated.")
    ] = None,
    out: Annotated[Path | None, typer.Option(help="Write the records to this file, as JSON.")] = None,
    limit: Limit = LIMIT,
) -> None:
    """Run one hard case on one mesh and print its checks."""
    runner = Runner(RESULTS / "hard-cases" / "runs", processor_limit=limit)
    made = [record.make(runner, name, mesh, each) for each in interface or Interface]
    for entry in made:
        _tell(entry)
    if out:
        record.write(made, out)


def _tell(made: Record) -> None:
    result = "ended normally" if made.ended else f"failed: {made.failures}"
    console.print(
        f"{made.case}, {made.mesh} mesh, {made.interface}: {result}; {made.steps} steps, "
        f"{made.iterations} iterations, {made.retries} retries",
        markup=False,
    )
    for m in made.measures:
        bounds = f"<= {m.tolerance:.3g}" if m.lowest == -float("inf") else f"{m.lowest:.3g} to {m.tolerance:.3g}"
        console.print(
            f"  {'met   ' if m.passed else 'MISSED'} {m.name}: {m.value:.3g} ({bounds}) {m.note}", markup=False
        )
