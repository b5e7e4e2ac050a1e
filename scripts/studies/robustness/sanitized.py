"""The plugin with address and undefined-behaviour sanitizers: its build, how febio4 loads it, and what it reports."""

import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

from harness.errors import HarnessError
from harness.paths import PLUGIN_NAME, REPOSITORY

CONFIGURE, BUILD_PLUGIN = "sanitize", "sanitize-plugin"  # presets; the second builds the plugin alone
BUILD = REPOSITORY / "build" / CONFIGURE
REPORT = "sanitizer"  # stem of the files into which the address sanitizer writes, one for each process
SCREEN = "screen.txt"  # what febio4 and the undefined-behaviour sanitizer write
_SUMMARY = re.compile(r"^SUMMARY: \w+Sanitizer: (.*)$|runtime error: (.*)$", re.MULTILINE)
_LEAK = re.compile(r"^(?:Direct|Indirect) leak of (\d+) byte.*?\n((?:\s+#\d+.*\n)*)", re.MULTILINE)


@dataclass(frozen=True)
class Plugin:
    """The library, and the run-time library of the address sanitizer, if any, which febio4 loads first."""

    library: Path
    runtime: Path | None = None

    def environment(self, leaks: bool) -> dict[str, str]:
        """What febio4 needs around it to run with the library; `leaks` asks for a report of what is lost at its end.

        What febio4 itself does is let pass: it mixes `new []` and `delete` when it writes a plot file, copies a string
        onto itself when it restarts, and loses memory at its end.
        """
        if self.runtime is None:
            return {}
        written = f"log_path={REPORT}"
        return {
            "LD_PRELOAD": str(self.runtime),
            "ASAN_OPTIONS": f"{written}:alloc_dealloc_mismatch=0:replace_str=0:detect_leaks={int(leaks)}",
            "LSAN_OPTIONS": "exitcode=0",
            "UBSAN_OPTIONS": f"{written}:print_stacktrace=1",
        }


def build() -> Plugin:
    """Build the library in the folder of the sanitizers, `BUILD`.

    Raises HarnessError where the build fails, with the end of what it said, or where the compiler brings no address
        sanitizer.
    """
    ninja = REPOSITORY / ".venv" / "bin" / "ninja"
    made = [f"-DCMAKE_MAKE_PROGRAM={ninja}"] if ninja.exists() else []
    _call("cmake", "--preset", CONFIGURE, *made)
    _call("cmake", "--build", "--preset", BUILD_PLUGIN)
    library = BUILD / "lib" / PLUGIN_NAME
    if not library.is_file():
        raise HarnessError(f"{library} was not built: febio4 with its SDK is needed.")
    return Plugin(library, _runtime())


def _call(*command: str) -> str:
    done = subprocess.run(command, cwd=REPOSITORY, capture_output=True, text=True, errors="replace", check=False)
    if done.returncode != 0:
        end = "\n".join((done.stdout + done.stderr).splitlines()[-20:])
        raise HarnessError(f"{' '.join(command)} failed:\n{end}")
    return done.stdout


def _runtime() -> Path:
    cache = (BUILD / "CMakeCache.txt").read_text()
    found = re.search(r"^CMAKE_CXX_COMPILER:\w+=(.*)$", cache, re.MULTILINE)
    compiler = found.group(1) if found else "c++"
    path = Path(_call(compiler, "-print-file-name=libasan.so").strip())
    if not path.is_absolute():
        raise HarnessError(f"{compiler} brings no libasan.so, which febio4 has to load first; GCC does.")
    return path.resolve()


def reports(folder: Path) -> tuple[str, ...]:
    """What the sanitizers found in the runs of a folder, leaks left out: a line for each."""
    files = [*sorted(folder.glob(f"{REPORT}.*")), folder / SCREEN]
    texts = [path.read_text(errors="replace") for path in files]
    found = [" ".join(filter(None, match)) for text in texts for match in _SUMMARY.findall(text)]
    return tuple(dict.fromkeys(line for line in found if "leaked in" not in line))


def lost_bytes(folder: Path) -> int:
    """Bytes that were allocated on behalf of the plugin, and to which nothing pointed at the end of the run."""
    texts = [path.read_text(errors="replace") for path in sorted(folder.glob(f"{REPORT}.*"))]
    leaks = [leak for text in texts for leak in _LEAK.findall(text)]
    return sum(int(size) for size, stack in leaks if PLUGIN_NAME in stack)
