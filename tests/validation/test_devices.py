"""The devices of the solver: switched off by name, left out after a step has failed, and harmful to no scene."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import febio_runs
import numpy as np
import pytest
from scenes.cam import Cam
from scenes.tied_columns import column

from harness.conversion import convert
from harness.models.parts import Param, TimeStepper
from harness.run import engine, logdata
from harness.run.febio_log import Report
from studies.ablation import ablated_runs
from studies.models import small
from studies.models.ball_in_socket import BallInSocket
from studies.models.small import Document, Parts
from studies.synthetic_scenes.reported.kinds_of_scene import SCENES

pytestmark = pytest.mark.mixture_only

JOINT = BallInSocket(elements=4, steps=4, slides=False)
SOLUTION = 2e-3
"""Of the largest displacement: FEBio accepts a step whose last increment is 1e-3 of its displacements, and each of two
runs may be off by that."""


def _only(names: str) -> tuple[Param, ...]:
    return (Param("solver_devices", names),)


def _run(path: Path) -> tuple[Report, str]:
    report = febio_runs.run(path, plugin=engine.required_plugin(), check=False).report
    return report, path.with_suffix(".log").read_text(errors="replace")


def _run_joint(folder: Path, devices: str) -> tuple[np.ndarray, str]:
    """Displacements at the end, and the log."""
    folder.mkdir()
    model = replace(JOINT, params=_only(devices)).model()
    report, log = _run(model.write(folder))
    assert report.normal, report.errors
    history = logdata.read_history(folder / model.node_file, model.node_columns)
    return logdata.at_the_end(history, ("ux", "uy", "uz")), log


def test_without_devices_a_run_comes_to_the_same_solution_and_none_acts(runner, tmp_path):
    with_all, log = _run_joint(tmp_path / "all", "all")
    without, log_without = _run_joint(tmp_path / "none", "none")
    assert np.abs(with_all - without).max() <= SOLUTION * np.abs(without).max()
    acted = ablated_runs.ACTED.search(log)
    assert acted
    assert re.search(r"\bloads_as_unknowns \d+", acted.group(1))
    assert not ablated_runs.ACTED.search(log_without)
    assert "active devices of the solver: none." in log_without


@pytest.mark.parametrize("device", ablated_runs.devices())
def test_each_device_has_a_switch(runner, tmp_path, device):
    others = ", ".join(other for other in ablated_runs.devices() if other != device)
    _, log = _run_joint(tmp_path / device, others)
    acted = ablated_runs.ACTED.search(log)
    assert acted is None or device not in acted.group(1)


def test_a_device_that_does_not_exist_is_an_error_that_names_those_that_do(runner, tmp_path):
    report, _ = _run(replace(JOINT, params=_only("kept_matrix, magic")).model().write(tmp_path))
    said = " ".join(report.errors)
    assert not report.normal
    assert '<solver_devices> names "magic"; allowed: "all", "none", or some of the names' in said
    assert all(device in said for device in ablated_runs.devices())


@pytest.mark.parametrize("other", ["tied-mixture", "sliding-mixture"])
def test_contacts_and_ties_of_a_model_have_the_same_devices(runner, tmp_path, other):
    document, _ = column("solid", "<solver_devices>none</solver_devices>")
    clash = small.contact("second", "pair", other, "<solver_devices>kept_matrix</solver_devices>")
    path = tmp_path / "clash.feb"
    path.write_text(replace(document, contacts=(*document.contacts, clash)).text())
    report, _ = _run(path)
    assert not report.normal
    assert "<solver_devices> affects the whole model" in " ".join(report.errors)


def test_a_step_that_has_failed_is_tried_again_without_devices(runner, tmp_path):
    model = replace(JOINT, steps=1).model()
    hurried = replace(model.control, reformations=2, stepper=TimeStepper(1.0, retries=8, aggressive=True))
    report, log = _run(replace(model, control=hurried).write(tmp_path))
    assert report.retries > 0
    assert log.count("FEBio repeats it without the devices of the solver") == 1


def test_a_rigid_cam_under_a_rigid_follower_is_no_worse_for_the_devices(runner, tmp_path):
    """A node of a rigid body that closed too early would move the whole body."""
    taken = {}
    for name in ("all", "none"):
        path = tmp_path / f"{name}.feb"
        path.write_text(Cam(params=f"<penalty>100</penalty><solver_devices>{name}</solver_devices>").document().text())
        report, _ = _run(path)
        assert report.normal, report.errors
        assert report.retries == 0
        taken[name] = report.iterations
    assert taken["all"] <= 1.02 * taken["none"]


def _nearly_incompressible() -> Document:
    """A block pressed 0.1 mm into another one, then slid as far, with 10 updates of BFGS between two matrices."""
    parts = Parts()
    parts.box("lower", (0, 0, -1), (2, 2, 0), (6, 6, 2), "lower")
    parts.box("upper", (0.5, 0.5, 0), (1.5, 1.5, 0.8), (5, 5, 2), "upper")
    tight = "<dtol>1e-08</dtol><etol>1e-10</etol><rtol>1e-10</rtol>"
    control = small.control("solid", 10, 0.1, retries=5)
    control = control.replace("<max_ups>0<", "<max_ups>10<").replace("<max_refs>", f"{tight}<max_refs>")
    return Document(
        parts.mesh({"pair": ("upper-bottom", "lower-top")}),
        (small.elastic("lower", 1, 1.0, 0.4999), small.elastic("upper", 2, 1.0, 0.4999)),
        control=control,
        boundary=(
            small.fixed("lower-bottom", "x", "y", "z"),
            small.fixed("upper-top", "y"),
            small.moved("upper-top", "z", -0.1, 1),
            small.moved("upper-top", "x", 0.1, 2),
        ),
        contacts=(small.contact("c", "pair"),),
        curves=(small.curve(1, (0, 0), (0.5, 1), (1, 1)), small.curve(2, (0, 0), (0.5, 0), (1, 1))),
    )


def test_a_matrix_that_leaves_too_much_of_the_residual_is_formed_anew(runner, tmp_path):
    """With updates that corrections drop, iterations of nearly incompressible blocks hardly come nearer."""
    path = tmp_path / "blocks.feb"
    text = _nearly_incompressible().text()
    path.write_text(text)
    kept, _ = _run(path)
    path.write_text(text.replace("<max_ups>10<", "<max_ups>0<"))
    full, _ = _run(path)
    assert kept.normal
    assert full.normal
    assert kept.retries == 0
    assert kept.reformations < full.reformations
    assert kept.iterations <= 2 * full.iterations


def test_corrections_that_do_not_pay_end_with_the_second_matrix_of_a_step(runner, tmp_path):
    """A strip that folds: corrections leave much of the residual in the steps in which its sides meet.

    They take a sixth more iterations than full Newton if they go on there. The bound, a tenth, is a choice.
    """
    path = tmp_path / "fold.feb"
    text = convert.convert(SCENES["fold"].write("fold", tmp_path)).data.decode()
    path.write_text(re.sub("<max_ups>.*?<", "<max_ups>10<", text))
    kept, log = _run(path)
    path.write_text(re.sub("<max_ups>.*?<", "<max_ups>0<", text))
    full, _ = _run(path)
    assert kept.normal
    assert full.normal
    assert re.search(r"\bkept_matrix \d+", log)
    assert kept.reformations < full.reformations
    assert kept.iterations <= 1.1 * full.iterations
