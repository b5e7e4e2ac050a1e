"""Which FEBio the build takes: one whose headers have the hooks that the contact needs, whatever its number."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from harness.paths import REPOSITORY

PROJECT = f"""
cmake_minimum_required(VERSION 3.22)
cmake_policy(SET CMP0144 NEW)
project(probe CXX)
set(CMAKE_CXX_STANDARD 17)
list(APPEND CMAKE_MODULE_PATH "{(REPOSITORY / "cmake").as_posix()}")
find_package(FEBio MODULE)
"""
PAIR = """
#pragma once
#include <vector>
struct FETimeInfo {};
struct FESurfacePairConstraint {
  virtual int InitEquations(int) { return 0; }
  virtual void PrepStep() {}
  virtual void Update(const std::vector<double>&, const std::vector<double>&) {}
  virtual void UpdateIncrements(std::vector<double>&, const std::vector<double>&) {}
  virtual bool Augment(int, const FETimeInfo&) { return true; }
};
"""
CONTACT = """
#pragma once
#include <FECore/FESurfacePairConstraint.h>
struct FEGlobalVector {};
struct FELinearSystem {};
struct FEContactInterface : FESurfacePairConstraint {
  virtual void LoadVector(FEGlobalVector&, const FETimeInfo&) {}
  virtual void StiffnessMatrix(FELinearSystem&, const FETimeInfo&) {}
};
"""
SURFACE = """
#pragma once
struct vec3d {};
struct FEBiphasicContactSurface { virtual vec3d GetFluidForce() { return {}; } };
"""
NOT_TESTED = "was not tested with it"
ROOTS = [Path(root) for root in os.environ.get("FEBIO_ROOTS", "").split(os.pathsep) if root]


def fake_sdk(root: Path, pair: str = PAIR, release: str = "4.11", sdk: str = "4.10") -> Path:
    """Headers with the classes that the contact derives from, and empty libraries."""
    contents = {
        "FECore/FESurfacePairConstraint.h": pair,
        "FEBioMech/FEContactInterface.h": CONTACT,
        "FEBioMix/FEBiphasicContactSurface.h": SURFACE,
        "FECore/version.h": defines(("FE_SDK_MAJOR_VERSION", "FE_SDK_SUB_VERSION", "FE_SDK_SUBSUB_VERSION"), sdk),
        "FEBioLib/version.h": defines(("VERSION", "SUBVERSION", "SUBSUBVERSION"), release),
    }
    for name, text in contents.items():
        header = root / "include" / name
        header.parent.mkdir(parents=True, exist_ok=True)
        header.write_text(text)
    (root / "lib").mkdir()
    for name in ("fecore", "febiomech", "febiomix"):
        (root / "lib" / f"lib{name}.so").touch()
    return root


def defines(names: tuple[str, ...], version: str) -> str:
    return "".join(f"#define {name} {number}\n" for name, number in zip(names, f"{version}.0".split("."), strict=True))


def configure(folder: Path, sdk: Path) -> subprocess.CompletedProcess[str]:
    cmake = shutil.which("cmake")
    if cmake is None:
        pytest.skip("cmake is not on the PATH; `scripts/mixcontact test` puts it there")
    (folder / "project").mkdir()
    (folder / "project" / "CMakeLists.txt").write_text(PROJECT)
    command = [cmake, "-S", str(folder / "project"), "-B", str(folder / "build")]
    environment = {**os.environ, "FEBIO_ROOT": str(sdk)}
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=False)


def said(done: subprocess.CompletedProcess[str]) -> str:
    """What CMake printed, without its line breaks."""
    return re.sub(r"\s+", " ", done.stdout + done.stderr)


def test_the_tested_release_is_taken_without_a_notice(tmp_path):
    done = configure(tmp_path, fake_sdk(tmp_path / "sdk"))
    assert done.returncode == 0, done.stderr
    assert NOT_TESTED not in said(done)


@pytest.mark.parametrize(("release", "sdk"), [("4.12", "4.11"), ("5.0", "5.0"), ("4.11", "4.11")])
def test_another_one_with_all_hooks_is_taken_with_a_notice(release, sdk, tmp_path):
    done = configure(tmp_path, fake_sdk(tmp_path / "sdk", release=release, sdk=sdk))
    assert done.returncode == 0, done.stderr
    assert f"FEBio {release}.0 with plugin SDK {sdk}.0" in said(done)
    assert NOT_TESTED in said(done)


def test_one_without_hooks_is_refused_and_these_hooks_named(tmp_path):
    hooks = ["InitEquations", "PrepStep", "UpdateIncrements"]
    without = re.sub(rf".*\b({'|'.join(hooks)})\(.*\n", "", PAIR)
    done = configure(tmp_path, fake_sdk(tmp_path / "sdk", pair=without))
    assert done.returncode != 0
    assert sorted(re.findall(r"FESurfacePairConstraint: \w+ (\w+)\(", said(done))) == hooks


def test_functions_that_are_not_the_hooks_are_refused(tmp_path):
    """With the arguments of older releases, and one that FEBio cannot call since it is not virtual."""
    older = PAIR.replace(
        "Update(const std::vector<double>&, const std::vector<double>&)", "Update(std::vector<double>&)"
    ).replace("virtual void PrepStep", "void PrepStep")
    done = configure(tmp_path, fake_sdk(tmp_path / "sdk", pair=older, release="4.10"))
    assert done.returncode != 0
    named = re.findall(r"FESurfacePairConstraint: (\w+ \w+\([^)]*\))", said(done))
    assert sorted(named) == ["void PrepStep()", "void Update(const std::vector<double>&, const std::vector<double>&)"]


@pytest.mark.parametrize("root", ROOTS, ids=lambda root: root.name)
def test_febios_at_hand_are_taken_or_refused_by_their_hooks(root, tmp_path):
    pair = (root / "include" / "FECore" / "FESurfacePairConstraint.h").read_text(encoding="utf-8")
    done = configure(tmp_path, root)
    assert (done.returncode == 0) == ("PrepStep" in pair)
    assert ("FESurfacePairConstraint: void PrepStep()" in said(done)) == ("PrepStep" not in pair)
