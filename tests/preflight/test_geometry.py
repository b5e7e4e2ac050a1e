"""The pure functions behind the rules, on cases that can be seen at a glance."""

from __future__ import annotations

import numpy as np
import pytest

from harness.preflight import rays
from harness.preflight.finding import percent, short
from harness.preflight.rules.motion import free_motions
from harness.preflight.xml_file import integers, parse

UP = np.array([[0.0, 0.0, 1.0]])
FACE_DOWN = np.array([[(0, 0, 2), (0, 1, 2), (1, 1, 2), (1, 0, 2)]], dtype=float)
FACE_UP = FACE_DOWN[:, ::-1]


def hit(origin, faces, direction=UP):
    found = rays.nearest_facing(np.array([origin], dtype=float), direction, rays.triangles(faces))
    return float(found[0])


def test_a_ray_meets_what_faces_it_in_front_and_behind():
    assert hit((0.5, 0.4, 0.5), FACE_DOWN) == pytest.approx(1.5)
    assert hit((0.5, 0.4, 2.5), FACE_DOWN) == pytest.approx(-0.5)
    assert np.isnan(hit((0.5, 0.4, 0.5), FACE_UP))


def test_a_ray_misses_what_is_beside_it_or_along_it():
    assert np.isnan(hit((1.5, 0.5, 0.5), FACE_DOWN))
    assert np.isnan(hit((0.5, 0.5, 0.5), FACE_DOWN, np.array([[1.0, 0.0, 0.0]])))


def test_the_nearest_of_several():
    faces = np.concatenate([FACE_DOWN + 3.0 * UP, FACE_DOWN, FACE_DOWN - 4.0 * UP])
    assert hit((0.5, 0.4, 0.5), faces) == pytest.approx(1.5)
    assert hit((0.5, 0.4, -1.0), faces) == pytest.approx(-1.0)


def test_a_ray_leaves_a_body_beyond_its_start():
    start, least = np.array([[0.5, 0.4, 0.0]]), np.array([0.1])
    floor = FACE_UP - 2.0 * UP
    found = rays.first_exit(start, UP, rays.triangles(np.concatenate([floor, FACE_UP])), least)
    assert found[0] == pytest.approx(2.0)


def test_triangles_with_a_repeated_corner_are_met_once():
    triangle = FACE_DOWN.copy()
    triangle[:, 3] = triangle[:, 2]
    assert hit((0.2, 0.8, 0.0), triangle) == pytest.approx(2.0)
    assert np.isnan(hit((0.8, 0.2, 0.0), triangle))


def held(*rows):
    return np.array(rows, dtype=float).reshape(-1, 6)


@pytest.mark.parametrize(
    ("rows", "expected"),
    [
        (np.empty((0, 6)), ["in all directions"]),
        (np.eye(6), []),
        (np.eye(6)[:5], ["in rotation"]),
        (np.eye(6)[[0, 1, 3, 4, 5]], ["along z"]),
        (np.eye(6)[[2, 3, 4, 5]], ["along x", "along y"]),
        (held((1, 1, 0, 0, 0, 0), *np.eye(6)[2:]), ["in an oblique direction"]),
        (1e-9 * np.eye(6), []),
    ],
)
def test_free_motions(rows, expected):
    assert free_motions(rows) == expected


@pytest.mark.parametrize(("value", "text"), [(5e3, "5000"), (0.04, "0.04"), (123.4, "120"), (1e9, "1e+09"), (0.0, "0")])
def test_short_numbers(value, text):
    assert short(value) == text


def test_percentages():
    assert percent(1 / 3) == "33 %"
    assert percent(0.048) == "4.8 %"


def test_lists_of_numbers(tmp_path):
    path = tmp_path / "model.feb"
    path.write_text('<?xml version="1.0"?><febio_spec version="4.0"><Mesh>1,3:5, 10:20:5\n7</Mesh></febio_spec>')
    assert integers(parse(path)[0]) == [1, 3, 4, 5, 10, 15, 20, 7]
