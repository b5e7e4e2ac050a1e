"""Bodies that are tied behave as one: cut and uncut, through a kept gap, turned, continued."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from studies.models import small
from studies.models.small import Document, Parts, biphasic, contact, control, curve, elastic, fixed, moved

pytestmark = pytest.mark.mixture_only

RAMP = curve(1, (0, 0), (1, 1))
SOLUTE = (
    '<solute sol="1"><diffusivity type="diff-const-iso"><free_diff>0.5</free_diff><diff>0.5</diff></diffusivity>'
    '<solubility type="solub-const"><solub>1</solub></solubility></solute>'
)
SOLUTES = (
    '<Solutes><solute id="1" name="s1"><charge_number>0</charge_number><molar_mass>1</molar_mass>'
    "<density>1</density></solute></Solutes>"
)
MODULES = {"solid": "ux;uy;uz", "biphasic": "ux;uy;uz;p", "solute": "ux;uy;uz;p;c1"}
HIGHEST = 2.0


def mixed(name: str, number: int) -> str:
    """A biphasic-solute material."""
    text = biphasic(name, number).replace('type="biphasic"', 'type="biphasic-solute"')
    osmotic = '<osmotic_coefficient type="osm-coef-const"><osmcoef>1</osmcoef></osmotic_coefficient>'
    return text.replace("</material>", f"{osmotic}{SOLUTE}</material>")


def material(module: str, name: str, number: int) -> str:
    """The material of a module's bodies."""
    return {"solid": elastic, "biphasic": biphasic, "solute": mixed}[module](name, number)


def prescribed(kind: str, where: str, value: float, dof: str = "") -> str:
    """A prescribed pressure or concentration that follows the ramp."""
    inner = f'{dof}<value lc="1">{value}</value><relative>0</relative>'
    return f'<bc type="prescribed {kind}" node_set="{where}">{inner}</bc>'


def column(
    module: str, params: str | None, *, cells: tuple[int, int] = (3, 3), gap: float = 0.0, flips: bool = False
) -> tuple[Document, Parts]:
    """A column of one body, or of two that are tied: drawn, sheared and twisted, with flow and diffusion along it."""
    parts = Parts()
    if params is None:
        parts.box("low", (0, 0, 0), (1, 1, HIGHEST), (3, 3, 6), "low")
        parts.node_sets["up-top"] = parts.node_sets.pop("low-top")
    else:
        parts.box("low", (0, 0, 0), (1, 1, 1), (cells[0], cells[0], 3), "low")
        parts.box("up", (0, 0, 1 + gap), (1, 1, HIGHEST + gap), (cells[1], cells[1], 3), "up")
    top = [(n, parts.nodes[n - 1]) for n in parts.node_sets["up-top"]]
    parts.node_sets["left"] = [n for n, x in top if x[0] < 0.5]
    parts.node_sets["right"] = [n for n, x in top if x[0] > 0.5]
    boundary = [fixed("low-bottom", "x", "y", "z"), moved("up-top", "x", 0.05), moved("up-top", "z", 0.1)]
    boundary += [moved("left", "y", -0.05), moved("right", "y", 0.05)]
    if module != "solid":
        boundary += [prescribed("fluid pressure", "low-bottom", 0.2), prescribed("fluid pressure", "up-top", 0.0)]
    if module == "solute":
        boundary.append(prescribed("concentration", "low-bottom", 1.0, "<dof>c1</dof>"))
        boundary.append(prescribed("concentration", "up-top", 0.2, "<dof>c1</dof>"))
    pair = ("low-top", "up-bottom") if flips else ("up-bottom", "low-top")
    document = Document(
        parts.mesh({"pair": pair} if params is not None else {}),
        tuple(material(module, part.material, n) for n, part in enumerate(parts.parts, 1)),
        module=module,
        control=control(module, 2, 0.5, analysis="STATIC" if module == "solid" else "TRANSIENT"),
        boundary=boundary,
        contacts=() if params is None else (contact("tie", "pair", "tied-mixture", params),),
        curves=(RAMP,),
        node_data=MODULES[module],
        globals=SOLUTES if module == "solute" else "",
    )
    return document, parts


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


@pytest.mark.parametrize("module", MODULES)
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
    _, finished = solve("far", column("solid", "<search_radius>0.1</search_radius>", gap=0.5)[0], ends=False)
    assert "nothing is tied" in finished.output
