"""The command that compares the two engines node by node."""

from pathlib import Path
from typing import Annotated

import typer

from harness.choice import chosen
from harness.paths import RESULTS
from harness.post.compare import missed
from harness.run.hosts import FEBIO4, STANDALONE
from harness.run.runner import Runner
from studies.engines.engine_agreement import COMPARISONS, compare
from studies.options import console


def engines(
    only: Annotated[
        list[str] | None, typer.Option(help="Compare only this problem. The option may be repeated.")
    ] = None,
    folder: Annotated[Path, typer.Option(help="Write runs to this folder.")] = RESULTS,
) -> None:
    """Run problems 3.1 to 3.3 with febio4 and the embedded engine, with tight tolerances, and compare all nodes."""
    known = {comparison.name: comparison for comparison in COMPARISONS}
    names = chosen(only, known)
    runners = [Runner(folder / "engines" / host.name, host=host) for host in (FEBIO4, STANDALONE)]
    failures = 0
    for name in names:
        measures = compare(known[name], runners)
        failures += len(missed(measures))
        for m in measures:
            verdict = "met" if m.passed else "missed"
            console.print(f"{m.name:22} {m.value:9.1e} <= {m.tolerance:.0e} {verdict:6} {m.note}", markup=False)
    if failures:
        raise typer.Exit(1)
