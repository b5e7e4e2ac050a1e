"""The command line."""

from __future__ import annotations

import os
import re
import subprocess
import sys

import pytest

from harness.models.diffusion import Diffusion
from harness.models.interface import InterfaceType
from harness.models.parts import Control
from harness.paths import REPOSITORY
from harness.run import engine
from studies.cli import COMMANDS, main


def harness(*arguments, **environment):
    """Run the command line in a process of its own."""
    return subprocess.run(
        [sys.executable, "-m", "studies", *map(str, arguments)],
        env={**os.environ, "PYTHONPATH": str(REPOSITORY / "scripts"), "COLUMNS": "200", **environment},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.fixture
def within(monkeypatch, capsys):
    """Runs the command line in the process of the test: its exit code, and what it says of errors."""

    def run(*arguments):
        monkeypatch.setattr(sys, "argv", ["mixcontact", *map(str, arguments)])
        with pytest.raises(SystemExit) as ended:
            main()
        return ended.value.code, capsys.readouterr().err

    monkeypatch.setenv("COLUMNS", "200")
    return run


def test_models_are_written_and_checked(within, tmp_path):
    assert within("models", "--folder", tmp_path) == (0, "")
    assert within("models", "--folder", tmp_path, "--check") == (0, "")
    (tmp_path / "diffusion.feb").write_text("changed")
    code, said = within("models", "--folder", tmp_path, "--check")
    assert code == 2
    assert "diffusion.feb" in said


def test_without_febio_the_rest_is_done_and_the_reason_given(tmp_path):
    nothing = {"FEBIO_ROOT": str(tmp_path), "HOME": str(tmp_path), "PATH": str(tmp_path)}
    finished = harness("validate", "--engine", "febio4", "--folder", tmp_path, **nothing)
    assert finished.returncode == 3
    said = " ".join(finished.stdout.split())
    assert "febio4 was not found" in said
    assert "Left out: diffusion, " in said
    assert {"validation.json", "figure-3.2.png", "figure-3.3.png"} <= {path.name for path in tmp_path.iterdir()}
    assert harness("plot", tmp_path / "validation.json").returncode == 0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("run", "none.feb"), "none.feb: cannot be read"),
        (("run", "README.md"), "a model file ends in .feb"),
        (("plot", "none.json"), "cannot read none.json"),
        (("validate", "--only", "everything"), "'everything' is not one of closed-forms, diffusion"),
        (("validate", "--interface", "conforming"), "'conforming' is the reference of the others"),
        (("validate", "--interface", "glue"), "'glue'"),
    ],
)
def test_bad_input_is_explained(within, monkeypatch, arguments, message):
    monkeypatch.chdir(REPOSITORY)
    code, said = within(*arguments)
    assert code == 2
    assert message in said
    assert "Traceback" not in said


def test_a_bar_that_is_missed_is_a_failure(runner, tmp_path):
    finished = harness(
        "validate",
        "--interface",
        InterfaceType.SOLUTE.value,
        "--only",
        "layers",
        "--folder",
        tmp_path,
    )
    assert finished.returncode == 1
    assert "miss their tolerances" in finished.stdout


def test_run_reports_what_a_run_took(runner, interface, tmp_path):
    path = Diffusion(interface, elements=4, control=Control(5, 200.0)).model().write(tmp_path)
    finished = harness("run", path)
    assert finished.returncode == 0
    assert "normal termination, 5 steps" in finished.stdout


def test_run_quotes_febio_where_it_fails(runner, tmp_path):
    path = Diffusion(InterfaceType.CONFORMING, elements=1, control=Control(5, 200.0)).model().write(tmp_path)
    path.write_text(path.read_text().replace("<E>10</E>", "<modulus>10</modulus>"))
    finished = harness("run", path)
    assert finished.returncode == 2
    assert "modulus" in finished.stderr


def test_the_help_of_the_entry_lists_every_command(entry_module):
    """`scripts/mixcontact --help` needs no set-up, so its list is written out; it is that of the harness."""
    done = subprocess.run(
        [sys.executable, str(REPOSITORY / "scripts" / "mixcontact"), "--help"],
        capture_output=True,
        text=True,
        check=True,
    )
    entries = re.findall(r"^  ((?:[a-z-]+, )*[a-z-]+)  +\S", done.stdout, re.MULTILINE)
    listed = {name for entry in entries for name in entry.split(", ")}
    assert done.stdout.startswith("Usage: scripts/mixcontact ")
    assert listed == {*COMMANDS, *entry_module.OWN_COMMANDS}


def test_the_help_begins_with_the_commands_of_a_user(entry_module):
    assert entry_module.known_commands()[:5] == ["convert", "check", "run", "report", "validate"]


@pytest.fixture
def fresh(tmp_path):
    """The entry as it stands in a new clone, where nothing is set up."""
    (tmp_path / "scripts").mkdir()
    entry = tmp_path / "scripts" / "mixcontact"
    entry.write_text((REPOSITORY / "scripts" / "mixcontact").read_text(encoding="utf-8"))
    entry.chmod(0o755)
    return entry


@pytest.mark.parametrize("arguments", [("--help",), ("help",), ("test", "--help"), ("build", "-h")])
def test_help_sets_up_nothing(fresh, arguments):
    done = subprocess.run([fresh, *arguments], capture_output=True, text=True, check=True)
    assert done.stdout.startswith("Usage: scripts/mixcontact ")
    assert [path.name for path in fresh.parents[1].iterdir()] == ["scripts"]


def test_a_mistyped_command_is_named_and_sets_up_nothing(fresh):
    done = subprocess.run([fresh, "validte"], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "there is no command 'validte'. Is it validate?" in done.stderr
    assert [path.name for path in fresh.parents[1].iterdir()] == ["scripts"]


def test_the_reader_of_the_help_may_leave(fresh):
    script = f"{fresh} --help | head -1; exit ${{PIPESTATUS[0]}}"
    done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("command", ["check", "convert", "models", "plot"])
def test_commands_that_read_and_write_files_compile_nothing(entry_module, monkeypatch, command):
    done = []
    monkeypatch.setattr(entry_module, "set_up_python", lambda groups=(): done.append(groups))
    monkeypatch.setattr(entry_module, "set_up", lambda *_: done.append("compiled"))
    monkeypatch.setattr(entry_module, "harness", len)
    assert entry_module.main([command, "model.feb"]) == 2
    assert done == [()]


@pytest.mark.parametrize(("arguments", "steps"), [([], [("report",)]), (["--run"], ["compiled"])])
def test_report_compiles_where_it_runs_the_model_first(entry_module, monkeypatch, arguments, steps):
    done = []
    monkeypatch.setattr(entry_module, "set_up_python", lambda groups=(): done.append(groups))
    monkeypatch.setattr(entry_module, "set_up", lambda *_: done.append("compiled"))
    monkeypatch.setattr(entry_module, "harness", len)
    entry_module.main(["report", "model.feb", *arguments])
    assert done == steps
    assert "report" in entry_module.groups_of("report", [*arguments])


@pytest.mark.parametrize(
    ("arguments", "targets"),
    [
        (["validate"], "for_models"),
        (["run", "model.feb"], "for_models"),
        (["run", "model.feb", "--engine", "standalone"], "plugin/all"),
        (["report", "model.feb", "--run"], "for_models"),
        (["engines"], "plugin/all"),
        (["test", "--unit"], "all"),
        (["build"], "all"),
    ],
)
def test_a_command_compiles_what_it_needs(entry_module, arguments, targets):
    assert entry_module.targets_of(arguments[0], arguments[1:]) == targets


def test_febio4_is_found_where_the_build_finds_febio(tmp_path, monkeypatch):
    build = (REPOSITORY / "cmake" / "FindFEBio.cmake").read_text()
    assert [root.replace("~", "$ENV{HOME}") for root in engine.USUAL_ROOTS] == re.findall(
        r'"?((?:\$ENV\{HOME\}|/usr|/opt)/[\w/]+)"?', build[build.index('set(_febio_bases "$ENV{HOME}') :].split(")")[0]
    )
    monkeypatch.setattr(engine, "USUAL_ROOTS", ("~/febio4", "~/FEBioStudio"))
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.delenv("FEBIO_ROOT", raising=False)
    program = tmp_path / "FEBioStudio" / "febio" / "bin" / "febio4"
    program.parent.mkdir(parents=True)
    program.write_text("#!/bin/sh\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", "")
    assert engine.find_engine() == program
