"""A surface that several contacts share: records of the log name a surface, and have what it has by all of them."""

from __future__ import annotations

import febio_runs
import numpy as np
import pytest

from harness.run import engine
from studies.models import small
from studies.models.small import Document, Parts, contact, control, curve, elastic, fixed, moved

pytestmark = pytest.mark.mixture_only

DATA = "contact_force.x;contact_force.z;friction_force.x;contact area"


def two_on_one(second: str = "sliding-mixture") -> Document:
    """Two blocks on one, pressed down by different depths and dragged; with friction on one of them alone."""
    parts = Parts()
    parts.box("low", (0, 0, 0), (3, 1, 1), (6, 2, 2), "soft")
    parts.box("one", (0.2, 0.1, 1), (1, 0.9, 1.5), (2, 2, 1), "soft")
    parts.box("two", (1.8, 0.1, 1), (2.6, 0.9, 1.5), (2, 2, 1), "soft")
    down = tuple(moved(f"{name}-top", "z", -depth) for name, depth in (("one", 0.05), ("two", 0.1)))
    aside = tuple(moved(f"{name}-top", "x", 0.05) for name in ("one", "two"))
    params = "<penalty>20</penalty>"
    return Document(
        parts.mesh({"a": ("one-bottom", "low-top"), "b": ("two-bottom", "low-top")}),
        (elastic("soft", 1, 1, 0.3),),
        control=control("solid", 2, 0.5),
        boundary=(fixed("low-bottom", "x", "y", "z"), *down, *aside, fixed("one-top", "y"), fixed("two-top", "y")),
        contacts=(
            contact("a", "a", params=f"{params}<fric_coeff>0.2</fric_coeff>"),
            contact(
                "b", "b", second, params if second == "sliding-mixture" else f"{params}<search_radius>1</search_radius>"
            ),
        ),
        curves=(curve(1, (0, 0), (1, 1)),),
        surface_data=dict.fromkeys(("low-top", "one-bottom", "two-bottom"), DATA),
    )


@pytest.fixture
def records(runner, tmp_path):
    """What the log has of each surface in the end."""

    def run(document: Document):
        path = tmp_path / "model.feb"
        path.write_text(document.text())
        febio_runs.run(path, plugin=engine.required_plugin())
        return {name: small.table(tmp_path / f"surface-{name}.txt")[-1, 0] for name in document.surface_data}

    return run


def test_the_record_of_a_shared_surface_is_the_sum(records):
    of = records(two_on_one())
    signs = np.array([-1, -1, -1, 1])
    assert np.abs(of["one-bottom"]).min() > 0
    assert np.abs(of["two-bottom"][[1, 3]]).min() > 0
    np.testing.assert_allclose(of["low-top"], signs * (of["one-bottom"] + of["two-bottom"]), rtol=1e-9)


def test_contacts_of_febio_are_left_to_febio(records):
    of = records(two_on_one("sliding-elastic"))
    np.testing.assert_allclose(of["low-top"][:3], -of["one-bottom"][:3], rtol=1e-9)
