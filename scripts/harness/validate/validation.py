"""The main job: make every check, keep what was found, leave out what cannot be done and say why."""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path

from harness.errors import EngineFailedError, EngineNotFoundError, PluginNotFoundError
from harness.indentation import figures as indentation_figures
from harness.indentation import histories
from harness.post.compare import Measure
from harness.validate import figures
from harness.validate.checks import Check, Context, indentation_pair
from harness.validate.results import Results

_PROFILES = {"diffusion": figures.diffusion_profiles, "convection": figures.convection_profiles}
Finished = Callable[[Check], None]


def validate(context: Context, checks: Sequence[Check], *, jobs: int = 1, finished: Finished | None = None) -> Results:
    """Make the checks.

    jobs: number of febio4 runs at a time.
    finished: called after each check.
    Returns: a check whose engine or plugin is missing is left out with the reason; one whose run fails has a measure
        that misses its tolerance and quotes FEBio.
    """
    results = Results(context.interface.value)

    def make(check: Check) -> None:
        try:
            results.checks[check.name] = check.run(context)
            results.profiles.extend(_PROFILES[check.name](context) if check.name in _PROFILES else ())
        except (EngineNotFoundError, PluginNotFoundError) as error:
            results.left_out[check.name] = str(error)
        except EngineFailedError as error:
            results.checks[check.name] = [Measure(f"{check.name}: the run", float("nan"), 0.0, note=str(error))]
        if finished:
            finished(check)

    with ThreadPoolExecutor(max_workers=max(1, jobs)) as pool:
        list(pool.map(make, checks))
    results.left_out = {check.name: results.left_out[check.name] for check in checks if check.name in results.left_out}
    results.checks = {check.name: results.checks[check.name] for check in checks if check.name in results.checks}
    return results


def draw(context: Context, results: Results, folder: Path) -> list[Path]:
    """Draw what was found: figures 3.2 and 3.3 of profiles, figure 3.4 and its curves of the run of problem 3.3."""
    pictures = figures.draw(results.profiles, folder)
    if "indentation" in results.checks:
        with suppress(EngineFailedError):  # the check says why
            run, _ = indentation_pair(context)
            pictures += indentation_figures.draw(run, histories.curves(run), folder)
    return pictures
