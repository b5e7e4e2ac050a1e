"""The commands `biphasic-hertz` and `elastic-hertz`."""

from harness.paths import RESULTS
from harness.run.runner import Runner
from studies import files, stamps
from studies.hertz import elastic_profiles, figures, growth_records
from studies.options import Site, console

DATA, PICTURE = "data/biphasic-hertz.csv", "images/biphasic-hertz.svg"
ELASTIC_DATA, ELASTIC_PICTURE = "data/elastic-hertz.csv", "images/elastic-hertz.svg"


def biphasic_hertz(folder: Site = RESULTS / "hertz") -> None:
    """Press two thin biphasic layers together, on two meshes, and compare with the closed form."""
    runner = Runner(RESULTS / "runs")
    rows = []
    for problem in growth_records.PROBLEMS:
        own = growth_records.records(problem, runner)
        rows += own
        errors = growth_records.largest_errors(own, problem.load.points[1][0])
        console.print(f"{problem.name}: " + ", ".join(f"{name} {error:.2%}" for name, error in errors.items()))
    files.write_csv(rows, growth_records.Record, folder / DATA, stamps.stamp())
    console.print(f"Written: {folder / DATA}, {figures.draw(rows, folder / PICTURE)}")


def elastic_hertz(folder: Site = RESULTS / "hertz") -> None:
    """Press a cylinder and a sphere on a block, on two meshes each, and compare with Hertz's closed forms."""
    rows = elastic_profiles.all_rows(Runner(RESULTS / "runs"))
    files.write_csv(rows, elastic_profiles.ProfileRow, folder / ELASTIC_DATA, stamps.stamp())
    console.print(f"Written: {folder / ELASTIC_DATA}, {figures.draw_elastic(rows, folder / ELASTIC_PICTURE)}")
