"""Bodies that are tied behave as one: cut and uncut, through a kept gap, turned, continued."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import febio_runs
import numpy as np
import pytest
from scenes.tied_columns import EXACTLY, MODULES, RAMP, column, material, steps

from harness.run import engine
from studies.models import small
from studies.models.small import Document, Parts, contact, control, curve, elastic, fixed, moved, rigid, step

pytestmark = pytest.mark.mixture_only


def at_places(folder: Path, parts: Parts) -> dict[tuple[float, ...], list[np.ndarray]]:
    """Values at the end by where nodes were; two at the joint."""
    found: dict[tuple[float, ...], list[np.ndarray]] = {}
    for point, values in zip(parts.nodes, small.table(folder / "nodes.txt")[-1], strict=True):
        found.setdefault(tuple(np.round(point, 6)), []).append(values)
    return found


def errors(solve, module: str, params: str) -> np.ndarray:
    """Largest differences of cut and uncut, over the largest value of each quantity."""
    folders = {}
    for name, chosen in (("one", None), ("two", params)):
        document, parts = column(module, chosen)
        folder, _ = solve(f"{module}-{name}", document)
        folders[name] = at_places(folder, parts)
    assert folders["one"].keys() == folders["two"].keys()
    one = np.array([folders["one"][place][0] for place in folders["one"] for _ in folders["two"][place]])
    two = np.array([values for place in folders["one"] for values in folders["two"][place]])
    return np.asarray(np.abs(two - one).max(axis=0) / np.abs(one).max(axis=0))


WRONG = [("<penalty>-1</penalty>", "<penalty> is -1"), ("<effects>heat</effects>", "<effects> names")]
TIGHT = "<tolerance>1e-9</tolerance><maxaug>30</maxaug>"


@pytest.mark.parametrize("module", ["solid", "biphasic", "solute"])
@pytest.mark.parametrize(
    ("params", "motion", "fields"),
    [
        ("", 1e-3, 1e-6),
        (f"<laugon>AUGLAG</laugon>{TIGHT}", 1e-8, 1e-8),
        ("<laugon>LAGMULT</laugon>", 1e-8, 1e-8),
    ],
    ids=["PENALTY", "AUGLAG", "LAGMULT"],
)
def test_a_body_that_is_cut_and_tied_is_as_it_was(solve, module, params, motion, fields):
    found = errors(solve, module, params)
    assert found[:3].max() <= motion
    assert np.all(found[3:] <= fields)


@pytest.mark.parametrize(("tag", "said"), WRONG)
def test_values_that_make_no_sense_are_named(solve, tag, said):
    _, finished = solve("wrong", column("solid", tag)[0], ends=False)
    assert said in finished.output


def test_surfaces_out_of_reach_are_an_error(solve):
    folder, finished = solve("far", column("solid", "<search_radius>0.1</search_radius>", gap=0.5)[0], ends=False)
    assert "nothing is tied" in finished.output
    log = (folder / "model.log").read_text()
    assert "E R R O R   T E R M I N A T I O N" in log
    assert "Retrying" not in log


# ---- rigid motion ----


def turned(params: str, gap: float) -> tuple[Document, Parts]:
    """A rigid block that turns by a quarter, and an elastic one of another mesh that is tied to it."""
    parts = Parts()
    parts.box("low", (0, 0, 0), (1, 1, 0.5), (2, 2, 1), "low")
    parts.box("up", (0, 0, 0.5 + gap), (1, 1, 1 + gap), (3, 3, 2), "up")
    held = "".join(f"<{dof}_dof>1</{dof}_dof>" for dof in ("Rx", "Ry", "Rz", "Rv", "Rw"))
    turn = f'<dof>Ru</dof><value lc="1">{np.pi / 2!r}</value><relative>0</relative>'
    document = Document(
        parts.mesh({"pair": ("up-bottom", "low-top")}),
        (rigid("low", 1), elastic("up", 2, 1.0, 0.3)),
        control=steps("solid", 18, 1 / 18),
        rigid=(
            f'<rigid_bc type="rigid_fixed"><rb>low</rb>{held}</rigid_bc>',
            f'<rigid_bc type="rigid_rotation"><rb>low</rb>{turn}</rigid_bc>',
        ),
        contacts=(contact("tie", "pair", "tied-mixture", params),),
        curves=(RAMP,),
        rigid_data={1: "Fx;Fy;Fz;Mx;My;Mz"},
    )
    return document, parts


def stresses(folder: Path) -> np.ndarray:
    """Stresses of all elements at the end."""
    return np.asarray(small.table(folder / "stress.txt")[-1])


FACTORS = {
    "": 1e6,
    "<auto_penalty>1</auto_penalty><penalty>1e5</penalty>": 1e5,
    "<laugon>LAGMULT</laugon>": 0.0,
}
"""Penalties by parameters of the tie, as multiples of the stiffness of the elements, 2 N/mm^3."""
PENALTIES = ("default penalty", "softer penalty", "multipliers")


def force_of_rounding(params: str) -> float:
    """Largest force and moment on the joint of 1 mm^2 that the rounding of positions causes.

    Positions between 1 and 2 mm have an error up to half their spacing, and the absolute weights of both sides in a
    gap vector add up to 2. A force is the penalty times this error.
    """
    return max(1e-10, 2 * FACTORS[params] * np.spacing(1.0))


STRESS = '<element_data data="sx;sy;sz;sxy;syz;sxz" file="stress.txt" delim=" "/>'


@pytest.mark.parametrize("gap", [0.0, 0.05, -0.03])
@pytest.mark.parametrize("params", FACTORS, ids=PENALTIES)
def test_bodies_that_are_tied_turn_without_stress(solve, params, gap):
    document, parts = turned(params, gap)
    folder, _ = solve("turned", document.text().replace("<logfile>", f"<logfile>{STRESS}"))
    places = np.array(parts.nodes) + small.table(folder / "nodes.txt")[-1]
    quarter = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
    assert np.abs(places - np.array(parts.nodes) @ quarter.T).max() <= 1e-10
    assert np.abs(stresses(folder)).max() <= 1e-10
    force_and_moment = small.table(folder / "rigid-1.txt")[-1]
    assert np.abs(force_and_moment).max() <= force_of_rounding(params)


PRESSED_ON = '<surface_load type="pressure" surface="{}"><pressure lc="2">{}</pressure></surface_load>'


@pytest.mark.parametrize("gap", [0.0, 0.05, -0.03])
@pytest.mark.parametrize("params", FACTORS, ids=PENALTIES)
def test_loads_and_moments_turn_with_bodies(solve, params, gap):
    """Pressures on two faces of the upper body, whose loads turn with the faces."""
    document, parts = turned(params, gap)
    loads = (PRESSED_ON.format("up-top", 0.1), PRESSED_ON.format("up-right", 0.05))
    document = replace(document, loads=loads, curves=(*document.curves, curve(2, (0, 0), (1, 1))))
    still = replace(document, rigid=(document.rigid[0].replace("<Rv", "<Ru_dof>1</Ru_dof><Rv"),))
    folders = [solve(name, each)[0] for name, each in (("turned", document), ("still", still))]
    places = [np.array(parts.nodes) + small.table(folder / "nodes.txt")[-1] for folder in folders]
    quarter = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
    assert np.abs(places[1] - np.array(parts.nodes)).max() > 0.05
    assert np.abs(places[0] - places[1] @ quarter.T).max() <= 1e-10
    loads = [small.table(folder / "rigid-1.txt")[-1, 0] for folder in folders]
    for part in (slice(0, 3), slice(3, 6)):
        assert np.abs(loads[1][part]).max() > 0.05
        assert np.abs(loads[0][part] - quarter @ loads[1][part]).max() <= force_of_rounding(params)


# ---- linear solvers ----


@pytest.mark.parametrize("laugon", ["PENALTY", "AUGLAG", "LAGMULT"])
def test_direct_solvers_find_the_same_solution(solve, laugon):
    """`skyline` with the symmetric part of the matrix: steps that are solved to rounding have the same solution."""
    document, _ = column("solute", f"<laugon>{laugon}</laugon>", cells=(2, 3))
    found = {}
    for solver in ("pardiso", "mkl_dss", "skyline"):
        text = document.text().replace("</qn_method>", f'</qn_method><linear_solver type="{solver}"/>')
        if solver == "skyline":
            text = text.replace(">non-symmetric<", ">symmetric<")
        found[solver] = small.table(solve(solver, text)[0] / "nodes.txt")[-1]
    for solver in ("mkl_dss", "skyline"):
        assert np.abs(found[solver] - found["pardiso"]).max() <= 1e-10


# ---- balances, restarts, threads ----

FLOWS = "contact_force.x;contact_force.y;contact_force.z;contact solvent flow;contact solute flow 1"
LAGGED = ["PENALTY", "AUGLAG", "LAGMULT"]


def with_output(document: Document) -> Document:
    """The same with what both surfaces exchange."""
    return replace(document, surface_data=dict.fromkeys(("up-bottom", "low-top"), FLOWS))


@pytest.mark.parametrize("laugon", LAGGED)
def test_what_one_body_loses_the_other_gains(solve, laugon):
    document, _ = column("solute", f"<laugon>{laugon}</laugon>", cells=(2, 3))
    folder, _ = solve("flows", with_output(document))
    low, up = (small.table(folder / f"surface-{name}.txt")[:, 0] for name in ("low-top", "up-bottom"))
    assert np.all(np.abs(low).max(axis=0) > 1e-6)
    assert np.all(np.abs(low + up).max(axis=0) <= 1e-12 * np.abs(low).max(axis=0))


@pytest.mark.parametrize("laugon", LAGGED)
def test_a_run_that_is_continued_is_as_one_that_was_not(solve, tmp_path, laugon):
    """Through a kept gap, and with multipliers from the steps before."""
    document, _ = column("solute", f"<laugon>{laugon}</laugon>{TIGHT}", cells=(2, 3), gap=0.02)
    text = document.text().replace("PLOT_NEVER", "PLOT_MAJOR_ITRS").replace("time_steps>2", "time_steps>4")
    folder, _ = solve("whole", text, options=("-dump=1", "-dump_stride=3"))
    part = shutil.copytree(folder, tmp_path / "part")
    (part / "nodes.txt").unlink()
    febio_runs.restart(part / "model.dmp", plugin=engine.required_plugin())
    whole, continued = (small.table(each / "nodes.txt")[-1] for each in (folder, part))
    assert np.abs(continued - whole).max() <= 1e-10


@pytest.mark.parametrize("laugon", LAGGED)
def test_two_threads_make_the_same_run(solve, monkeypatch, laugon):
    runs = []
    for threads in ("1", "2"):
        monkeypatch.setenv("OMP_NUM_THREADS", threads)
        document, _ = column("solid", f"<laugon>{laugon}</laugon>", cells=(2, 3), gap=0.02)
        folder, finished = solve(threads, document)
        runs.append((finished.report.iterations, small.table(folder / "nodes.txt")))
    assert runs[0][0] == runs[1][0]
    assert np.abs(runs[1][1] - runs[0][1]).max() <= 1e-10


# ---- what stands in the model beside it ----


def test_a_symmetric_matrix_gives_the_same_run(solve):
    """The tangent of a tie is symmetric, and so is that of elastic bodies."""
    found = []
    for kind in ("symmetric", "non-symmetric"):
        document, _ = column("solid", "<laugon>LAGMULT</laugon>", cells=(2, 3), gap=0.02)
        folder, finished = solve(kind, document.text().replace(">non-symmetric<", f">{kind}<"))
        found.append((finished.report.iterations, small.table(folder / "nodes.txt")[-1]))
    assert found[0][0] == found[1][0]
    assert np.abs(found[0][1] - found[1][1]).max() <= 1e-10


def test_gaps_are_closed_without_stress_where_nodes_move(solve):
    document, parts = turned("<node_reloc>1</node_reloc>", 0.02)
    still = document.text().replace(f"{np.pi / 2!r}", "0").replace(EXACTLY.split("<dtol>", maxsplit=1)[0], "")
    folder, finished = solve(
        "moved", still.replace("<logfile>", f'<logfile>{STRESS}<node_data data="z" file="z.txt"/>')
    )
    assert "kept" not in finished.output
    heights = small.table(folder / "z.txt")[-1][:, 0]
    lowest = [n for n, x in enumerate(parts.nodes) if abs(x[2] - 0.52) < 1e-9]
    assert np.abs(heights[lowest] - 0.5).max() <= 1e-12
    assert np.abs(stresses(folder)).max() <= 1e-10


@pytest.mark.parametrize("plate", ["elastic", "rigid"])
@pytest.mark.parametrize("laugon", ["PENALTY", "LAGMULT"])
@pytest.mark.parametrize("pair", [("up-bottom", "plate"), ("plate", "up-bottom"), ("up-bottom", "plate back")])
def test_faces_of_shells_are_tied_like_others(solve, pair, laugon, plate):
    """A block that is drawn and sheared stays on a plate that is held."""
    is_back = pair[1] == "plate back"
    params = f"<laugon>{laugon}</laugon>" + ("<shell_bottom_secondary>1</shell_bottom_secondary>" if is_back else "")
    parts = Parts()
    parts.plate("plate", "low", 0.1 if is_back else 0.0, 0.1, faces_up=not is_back)
    bottom = 0.2 if is_back else 0.0
    parts.box("up", (0, 0, bottom), (1, 1, bottom + 1), (2, 2, 2), "up")
    held = "".join(f"<{dof}_dof>1</{dof}_dof>" for dof in ("Rx", "Ry", "Rz", "Ru", "Rv", "Rw"))
    document = Document(
        parts.mesh({"pair": (pair[0].split()[0], pair[1].split()[0])}),
        (rigid("low", 1) if plate == "rigid" else elastic("low", 1, 5.0, 0.3), elastic("up", 2, 1.0, 0.3)),
        control=steps("solid", 2, 0.5),
        boundary=[moved("up-top", "x", 0.05), moved("up-top", "z", 0.1)]
        + ([fixed("plate", "x", "y", "z")] if plate == "elastic" else []),
        rigid=(f'<rigid_bc type="rigid_fixed"><rb>low</rb>{held}</rigid_bc>',) if plate == "rigid" else (),
        contacts=(contact("tie", "pair", "tied-mixture", params),),
        curves=(RAMP,),
    )
    folder, finished = solve("shell", document)
    assert finished.report.iterations <= 8
    moves = np.abs(small.table(folder / "nodes.txt")[-1][[n - 1 for n in parts.node_sets["up-bottom"]]]).max()
    assert moves <= 1e-6 if plate == "rigid" or not is_back else 1e-6 < moves < 0.05


@pytest.mark.parametrize("laugon", LAGGED)
def test_conditions_that_stand_twice_change_nothing(solve, laugon):
    """Two ties of the same surfaces: half a jump with penalties, and multipliers that share the load."""
    found = []
    for count in (1, 2):
        document, _ = column("solid", "", cells=(2, 3))
        names = ("one", "two")[:count]
        ties = tuple(contact(name, "pair", "tied-mixture", f"<laugon>{laugon}</laugon>") for name in names)
        folder, finished = solve(f"{count}", replace(document, contacts=ties))
        found.append((finished.report.iterations, small.table(folder / "nodes.txt")[-1]))
    assert found[0][0] == found[1][0]
    assert np.abs(found[0][1] - found[1][1]).max() <= (1e-10 if laugon == "LAGMULT" else 1e-7)


def three_blocks(module: str, tie: str, sliding: str) -> Document:
    """Two blocks that press on each other, each tied to a wide one below: some nodes are in two contacts."""
    parts = Parts()
    parts.box("wide", (0, 0, 0), (2, 1, 1), (4, 2, 2), "wide")
    parts.box("left", (0, 0, 1), (1, 1, 2), (3, 3, 3), "left")
    parts.box("right", (1, 0, 1), (2, 1, 2), (2, 2, 2), "right")
    pairs = {
        "one": ("left-bottom", "wide-top"),
        "two": ("right-bottom", "wide-top"),
        "side": ("left-right", "right-left"),
    }
    return Document(
        parts.mesh(pairs),
        tuple(material(module, part.name, number) for number, part in enumerate(parts.parts, 1)),
        module=module,
        control=control(module, 4, 0.25, analysis="STATIC" if module == "solid" else "TRANSIENT"),
        boundary=[fixed("wide-bottom", "x", "y", "z"), moved("left-left", "x", 0.05), moved("right-right", "x", -0.05)],
        contacts=(
            contact("one", "one", "tied-mixture", tie),
            contact("two", "two", "tied-mixture", tie),
            contact("side", "side", "sliding-mixture", sliding),
        ),
        curves=(RAMP,),
        node_data=MODULES[module],
    )


@pytest.mark.parametrize("sliding", ["", "<laugon>LAGMULT</laugon>"], ids=["sliding penalty", "sliding multipliers"])
@pytest.mark.parametrize("module", ["solid", "biphasic"])
def test_ties_and_sliding_contact_share_nodes(solve, module, sliding):
    found = []
    for laugon in ("PENALTY", "LAGMULT"):
        folder, finished = solve(laugon, three_blocks(module, f"<laugon>{laugon}</laugon>", sliding))
        assert finished.report.retries == 0
        assert finished.report.iterations <= 16
        found.append(small.table(folder / "nodes.txt")[-1])
    assert np.abs(found[0] - found[1]).max() <= 1e-3 * np.abs(found[1]).max()


# ---- later steps ----


def late(params: str, *, in_step: bool) -> Document:
    """A block that is let down onto another one, and drawn up again once it is tied; or that begins there, tied."""
    gap = 0.25 if in_step else 0.05
    parts = Parts()
    parts.box("low", (0, 0, 0), (1, 1, 1), (2, 2, 2), "low")
    parts.box("up", (0, 0, 1 + gap), (1, 1, 2 + gap), (3, 3, 2), "up")
    tie = contact("tie", "pair", "tied-mixture", params)
    part = steps("solid", 2, 0.5)
    down = curve(1, (0, 0), (1, -0.2), (2, -0.1)) if in_step else curve(1, (0, 0), (1, 0.1))
    timing = {"steps": (step(1, part), step(2, f"{part}<Contact>{tie}</Contact>"))} if in_step else {"control": part}
    return Document(
        parts.mesh({"pair": ("up-bottom", "low-top")}),
        (elastic("low", 1), elastic("up", 2)),
        boundary=(fixed("low-bottom", "x", "y", "z"), fixed("up-top", "x", "y"), moved("up-top", "z", 1.0)),
        contacts=() if in_step else (tie,),
        curves=(down,),
        node_data="x;y;z",
        **timing,
    )


@pytest.mark.parametrize("laugon", LAGGED)
def test_a_tie_of_a_later_step_begins_without_stress(solve, laugon):
    params = f"<laugon>{laugon}</laugon>"
    then, now = (solve(name, late(params, in_step=name == "then"))[0] for name in ("then", "now"))
    places = [small.table(folder / "nodes.txt")[-1] for folder in (then, now)]
    assert np.abs(places[0] - places[1]).max() <= 1e-9
    assert places[1][:, 2].max() > 2.1
