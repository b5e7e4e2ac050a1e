"""What the geometry couples across the contact stands beside the matrix."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import febio_runs
import pytest

from harness.run import engine
from studies.models import ball_in_socket
from studies.models.ball_in_socket import BallInSocket
from studies.price import joints

pytestmark = pytest.mark.mixture_only

ENTRIES = re.compile(r"Nr of nonzeroes in stiffness matrix \.+ : (\d+)")
SAID = "couplings across the contact are large compared with the stiffness of the bodies"
JOINT = BallInSocket(elements=4, steps=2)
POROUS = BallInSocket(elements=4, steps=4, porous=True, slides=False)


def _log(scene: BallInSocket, folder: Path) -> str:
    path = scene.model().write(folder)
    febio_runs.run(path, plugin=engine.required_plugin())
    return path.with_suffix(".log").read_text()


def _entries(log: str) -> list[int]:
    """Of each matrix that has a shape of its own."""
    return [int(number) for number in ENTRIES.findall(log)]


@pytest.mark.parametrize("scene", [JOINT, POROUS], ids=["elastic", "biphasic"])
def test_the_matrix_has_no_more_entries_than_with_febios_contact(runner, tmp_path, scene):
    ours = _log(scene, tmp_path / "ours")
    febio = _log(joints.rival(scene), tmp_path / "febio")
    assert SAID not in ours
    assert max(_entries(ours)) <= max(_entries(febio))


@pytest.mark.parametrize("updates", [0, 10])
def test_where_they_are_large_the_matrix_holds_them_from_there_on(runner, tmp_path, monkeypatch, updates):
    """A ball is pressed into a quarter of both layers, and goes sideways by as much as they are thick, in two steps."""
    monkeypatch.setattr(ball_in_socket, "PRESSED", 1.0)
    monkeypatch.setattr(ball_in_socket, "SLID", 4.0)
    log = _log(replace(JOINT, updates=updates), tmp_path)
    assert log.count(SAID) == 1
    before, after = log.split(SAID)
    assert _entries(before)[-1] < _entries(after)[0]
