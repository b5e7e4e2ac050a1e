"""The gallery: each model in its small version, and the page that shows them."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from PIL import Image

from harness.models.interface import InterfaceType
from harness.paths import DOCS, MODELS
from studies.models import delamination, joint, platens
from studies.pages.gallery import cycle, entries, figures, page
from studies.stamps import Stamp

ENTRIES = {entry.model.name: entry for entry in entries.ENTRIES}
PNG = b"\x89PNG"


@pytest.fixture(scope="module")
def shown(runner, interface):
    """Small version of a model: entry, outcome and curves."""
    if interface is not InterfaceType.MIXTURE:
        pytest.skip("the gallery shows sliding-mixture")

    def show(name):
        entry = ENTRIES[name]
        result = runner(entry.small)
        return entry, result, entries.curves(entry, result)

    return show


@pytest.mark.parametrize("name", ENTRIES)
def test_the_small_version_runs_and_is_drawn(shown, name, tmp_path):
    entry, result, curves = shown(name)
    drawn = figures.draw(entry, result, curves, tmp_path)
    assert [path.name for path in drawn] == [f"{name}-section.png", f"{name}-curves.png"]
    assert all(path.read_bytes().startswith(PNG) for path in drawn)
    assert result.report.retries == 0


def test_a_cycle_of_the_joint_is_an_animation_that_repeats(shown, tmp_path):
    """A frame for each second; the force rises and falls, so that no two frames that follow each other are the same."""
    drawn = cycle.draw(*shown("joint"), tmp_path / cycle.PICTURE)
    with Image.open(drawn) as picture:
        assert picture.n_frames == joint.PERIOD
        assert picture.info["loop"] == 0
        frames = []
        for number in range(picture.n_frames):
            picture.seek(number)
            frames.append(np.asarray(picture.convert("RGB")))
    assert all(np.any(a != b) for a, b in pairwise(frames))


@pytest.mark.parametrize("name", ENTRIES)
def test_the_small_version_is_the_same_problem(name):
    """It differs from the one in models/ in mesh, steps and output alone."""
    model, small = ENTRIES[name].model, ENTRIES[name].small
    assert (small.materials, small.conditions, small.contacts) == (model.materials, model.conditions, model.contacts)
    assert small.module == model.module
    assert len(small.mesh.nodes) < len(model.mesh.nodes)


def test_solute_enters_the_joint_with_each_layer_holding_its_share(shown):
    _, result, curves = shown("joint")
    assert all(content[0] == 0.0 and content[-1] > 0.04 for content in curves.contents.values())
    assert result.nodes["c1"].max() == pytest.approx(1.0, abs=0.02)
    assert curves.force is not None
    assert curves.force.argmax() == len(curves.times) - 1, "the load peaks at the end of the cycle"


def test_solute_of_the_upper_layer_crosses_into_the_lower_one(shown):
    """The fluid has none, so that what the lower layer gains comes across the contact."""
    _, _, curves = shown("joint-release")
    assert curves.contents["upper"][-1] < 0.97 * curves.contents["upper"][0]
    assert curves.contents["lower"][0] == 0.0
    assert curves.contents["lower"][-1] > 0.01 * curves.contents["upper"][0]


def test_the_graft_takes_up_what_the_host_hands_on(shown):
    _, _, curves = shown("graft")
    graft = curves.contents["graft"]
    assert np.all(np.diff(graft) > 0.0)
    inside, outside = curves.sides["graft-side"][-1], curves.sides["wall"][-1]
    assert inside == pytest.approx(outside, abs=0.02)


def test_the_force_on_the_platens_relaxes(shown):
    _, result, curves = shown("platens")
    assert curves.force is not None
    peak = int(np.abs(curves.force).argmax())
    assert curves.times[peak] == pytest.approx(platens.RAMP)
    assert abs(curves.force[-1]) < 0.5 * abs(curves.force[peak])
    assert set(curves.sides) == {"sample-bottom", "sample-top", "permeable-bottom"}
    assert "exchanges traction. No solvent" in result.log
    assert "exchanges traction, solvent, solute 1." in result.log


def test_solute_crosses_the_tie_of_the_plug_into_the_bone(shown):
    _, result, curves = shown("plug")
    assert np.all(np.diff(curves.contents["bone"]) >= 0.0)
    assert curves.contents["bone"][-1] > 0.1 * curves.contents["cartilage"][-1]
    assert "exchanges traction, solvent, solute 1." in result.log


def test_solute_enters_the_crack_below_the_layer(shown):
    """Nodes of the layer take the concentration of the bath once the crack is open there."""
    _, result, curves = shown("delamination")
    assert curves.contents["bone"][-1] > curves.contents["bone"][0]
    bottom = np.unique(result.model.mesh.surfaces["layer-bottom"]) - 1
    open_nodes = (np.abs(result.nodes["c1"][-1, bottom] - delamination.BATH) < 1e-6) & (
        result.nodes["x"][0, bottom] > 0
    )
    assert np.count_nonzero(open_nodes) >= 2


def test_records_that_were_made_with_something_else_are_left_out(tmp_path):
    stamp = Stamp("0.1.0", "abc1234", "FEBio 4.11.0")
    records = {"platens": page.Record(124, 28, 120, 251, 0, 1.4)}
    assert page.made_alike(tmp_path, stamp) == {}
    page.write(tmp_path, page.Results(stamp, records))
    assert page.read(tmp_path) == page.Results(stamp, records)
    assert page.made_alike(tmp_path, stamp) == records
    assert page.made_alike(tmp_path, replace(stamp, commit="def5678")) == {}


def test_the_page_shows_each_model_and_is_up_to_date():
    results = page.read(DOCS)
    assert list(results.records) == list(ENTRIES)
    assert page.page(results) == (DOCS / "gallery.md").read_text(encoding="utf-8")
    for name in ENTRIES:
        assert (MODELS / f"{name}.feb").is_file()
        for kind in ("section", "curves"):
            assert (DOCS / page.IMAGES / f"{name}-{kind}.png").is_file()
    assert (DOCS / page.IMAGES / cycle.PICTURE).is_file()
