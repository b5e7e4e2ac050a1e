"""The command `one-answer`."""

from concurrent.futures import ThreadPoolExecutor
from typing import Annotated

import typer

from harness.choice import chosen
from harness.paths import RESULTS
from harness.run import engine
from studies import feb as xml
from studies import files
from studies.feb import Feb
from studies.one_answer.answers import Answer, Answers
from studies.one_answer.edge_scenes import SCENES
from studies.options import TWO_AT_MOST, Folder, Timeout, console
from studies.robustness.execution import Way
from studies.robustness.sanitized import Plugin


def one_answer(
    only: Annotated[
        list[str] | None, typer.Option(help="Run only the scene of this name. The option may be repeated.")
    ] = None,
    timeout: Timeout = 600.0,
    folder: Folder = RESULTS / "one-answer",
    jobs: Annotated[int, typer.Option(min=1, help="Number of simultaneous scenes.")] = TWO_AT_MOST,
) -> None:
    """Solve porous scenes with an edge of contact in all ways: methods, threads, restarts, cutbacks, enforcement.

    The command runs small scenes first. The exit code is 0 if all runs complete and all results of one enforcement
    agree.
    """
    names = chosen(only, SCENES)
    way = Way(Plugin(engine.required_plugin()), timeout)
    scenes = sorted((SCENES[name].feb(name) for name in names), key=_size)

    def answers(scene: Feb) -> list[Answer]:
        found = []
        for answer in Answers(scene, way, folder.resolve() / "runs" / scene.name).all():
            found.append(answer)
            console.print(_line(answer), markup=False)
        return found

    with ThreadPoolExecutor(jobs) as pool:
        found = [answer for each in pool.map(answers, scenes) for answer in each]
    files.write_json(found, folder / "answers.json")
    differ = [answer for answer in found if not answer.is_the_same]
    console.print(f"{len(differ)} of {len(found)} runs do not end, or differ from what they should be the same as.")
    if differ:
        raise typer.Exit(1)


def _size(scene: Feb) -> int:
    """How long its runs take beside those of others: nodes times steps."""
    return len(scene.root.findall("Mesh/Nodes/node")) * sum(
        int(xml.number(each, "time_steps", 1)) for each in scene.controls
    )


def _line(answer: Answer) -> str:
    gap = "" if answer.difference is None else f"{answer.difference:.1e}"
    mark = "" if answer.is_the_same else "  <--"
    return (
        f"{answer.scene:24}{answer.way:36}{answer.ended:20}{answer.iterations:5} it {answer.retries:3} retries "
        f"{gap:>9}{mark}"
    )
