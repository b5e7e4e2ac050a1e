"""The commands of friction: its hard cases, published curves, and elastic slip against time."""

from typing import Annotated

import typer

from harness.choice import chosen
from harness.paths import RESULTS
from harness.run.runner import Runner
from studies import files, stamps
from studies.friction import curves, curves_table, page, stick_points
from studies.friction.curves import Row
from studies.friction.stick_points import Datum
from studies.hard_cases import rubbing_record
from studies.hard_cases.outcomes import Outcome
from studies.hard_cases.rubbing import CASES
from studies.hard_cases.scene import Fineness, Interface
from studies.options import Folder, Limit, Site, console
from studies.pages.evidence import DATA
from studies.stamps import LIMIT


def friction_cases(
    only: Annotated[list[str] | None, typer.Option(help="Run only this case. The option may be repeated.")] = None,
    mesh: Annotated[list[Fineness] | None, typer.Option(help="Run only this mesh.")] = None,
    febio: Annotated[bool, typer.Option(help="Also run FEBio's friction, with two factors on its penalties.")] = True,
    folder: Folder = RESULTS / "friction-cases",
    limit: Limit = LIMIT,
    docs: Annotated[bool, typer.Option("--docs", help="Also write the data of the documentation.")] = False,
) -> None:
    """Run the hard cases of friction on two meshes, with friction and without, and write the table.

    `pages` writes the page of the documentation from the data. The exit code is 0 if all runs complete and pass all
    checks.
    """
    cases = chosen(only, CASES)
    runner = Runner(folder / "runs", processor_limit=limit)
    others = (Interface.FEBIO_1, Interface.FEBIO_1000) if febio else ()
    records = []
    for each in mesh or Fineness:
        for name in cases:
            records.append(rubbing_record.make(runner, name, each, others))
            console.print(records[-1].line, markup=False)
    found, stamp = [outcome for record in records for outcome in record.outcomes], stamps.stamp(limit)
    files.write_csv(found, Outcome, folder / page.CASES_SOURCE, stamp)
    console.print(f"Written: {folder / page.CASES_SOURCE}")
    if docs:
        files.write_csv(found, Outcome, DATA / page.CASES_SOURCE, stamp)
        console.print(f"Written: {DATA / page.CASES_SOURCE}")
    if not all(record.passed for record in records):
        raise typer.Exit(1)


def friction_benchmarks(folder: Site = RESULTS / "friction-benchmarks", limit: Limit = LIMIT) -> None:
    """Turn a hemisphere on a block, press concentric spheres, on two meshes each, and compare with published curves."""
    runner = Runner(RESULTS / "runs", processor_limit=limit)
    rows: list[Row] = []
    for series in curves.HEMISPHERES:
        rows += curves.hemisphere_rows(series, runner)
    rows += curves.febio_rows(runner)
    for problem in curves.COEFFICIENTS:
        for series in curves.MESHES:
            rows += curves.sphere_rows(problem, series, runner)
    for measure in curves.torque_measures(rows, "fine mesh"):
        console.print(f"{measure.name}: {measure.value:.2%} from what published ones span", markup=False)
    rows += curves.published_rows()
    files.write_csv(rows, Row, folder / "data" / curves_table.SOURCE, stamps.stamp(limit))
    picture = curves_table.draw(rows, folder / curves_table.PICTURE)
    console.print(f"Written: {folder / 'data' / curves_table.SOURCE}, {picture}")


def friction_cost(folder: Site = RESULTS / "friction-cost", limit: Limit = LIMIT) -> None:
    """Measure elastic slip against time, by tangential penalty and with AUGLAG."""
    runner = Runner(RESULTS / "friction-cost" / "runs", processor_limit=limit)
    data = stick_points.measure(stick_points.points(), runner)
    console.print(stick_points.least_time(data), markup=False)
    files.write_csv(data, Datum, folder / "data" / stick_points.SOURCE, stamps.stamp(limit))
    picture = stick_points.draw(data, folder / stick_points.PICTURE)
    console.print(f"Written: {folder / 'data' / stick_points.SOURCE}, {picture}")
