"""The command `agreement`: by how much a converted model's answer differs, and which answer is nearer to a fine one."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from harness.choice import chosen
from harness.paths import DOCS, RESULTS
from studies import files, stamps
from studies.agreement import comparisons, page
from studies.options import Docs, Limit, console
from studies.pages.evidence import DATA
from studies.stamps import LIMIT


def agreement(
    only: Annotated[list[str] | None, typer.Option(help="Run only this scene. The option may be repeated.")] = None,
    folder: Annotated[Path, typer.Option(help="Write runs to this folder.")] = RESULTS / "agreement",
    limit: Limit = LIMIT,
    docs: Docs = False,
) -> None:
    """Run models with FEBio's interface and converted on finer and finer meshes, and compare both with the finest.

    The results are forces, areas of contact, contents, and fields. The command keeps runs that are already in the
    folder.
    """
    tell = partial(console.print, markup=False)
    rows = [row for name in chosen(only, comparisons.MESHES) for row in comparisons.compare(name, folder, limit, tell)]
    console.print(f"{page.headline(rows)}\n\n{page.details(rows)}\n\n{page.tables(rows)}", markup=False)
    if docs and not only:
        files.write_stamped(page.Results(stamps.stamp(limit), rows), DATA / page.SOURCE)
        for name, made in ((page.PAGE, page.page), (page.ALL, page.all_meshes)):
            (DOCS / name).write_text(made(page.read()), encoding="utf-8")
        console.print(f"Written: {page.PAGE}, {page.ALL}, {page.SOURCE} below {DOCS}")
