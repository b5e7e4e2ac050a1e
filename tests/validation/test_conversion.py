"""Models with FEBio's four sliding types give the same answer after `convert`. Both are run by febio4.

Where contact is uniform the tolerance is round-off and that of the solver; with AUGLAG and with unlike materials it is
what the penalties leave. At an edge of contact between meshes that do not match, FEBio's conditions at integration
points and ours at nodes agree as the mesh allows.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

import febio_runs
import numpy as np
import pytest
from lxml import etree
from older_formats import VERSIONS, in_instances, older
from scenes.patches import Patches

from harness.conversion.convert import convert
from harness.models.composite import Composite
from harness.models.confined import Confined
from harness.models.convection import Convection
from harness.models.diffusion import Diffusion
from harness.models.document import Model
from harness.models.interface import PAPER, ContactSettings, InterfaceType, augmented, automatic, contacts
from harness.models.layers import Layers
from harness.models.mesh import Box, assemble
from harness.models.parts import Control, Curve, Mixture, Param, Solid, displace, fix, pressure
from harness.preflight.model import read
from harness.run import engine, logdata
from studies.synthetic_scenes.collections_of_scenes import SCENES

pytestmark = pytest.mark.mixture_only

STIFF = automatic(1000.0)
BIPHASIC = replace(STIFF, concentration_penalty=None)
ELASTIC = replace(BIPHASIC, pressure_penalty=None)


def diffusion(interface, settings, **more):
    return Diffusion(interface, settings, elements=4, control=Control(10, 400.0), **more).model()


def confined(settings):
    # Loads are so small that FEBio takes the residual for zero after one iteration, which leaves 1.5e-6 of p.
    control = Control(10, 200.0, solver=(Param("min_residual", 1e-26),))
    return Confined(InterfaceType.BIPHASIC, settings, elements=5, control=control).model()


@dataclass(frozen=True)
class Case:
    """A model's text, the columns of its node data, and how far the answers may be apart; with Gauss points instead of
    the default, segments, where FEBio's own error of integration would be what is compared.
    """

    text: str
    columns: tuple[str, ...]
    file: str
    tolerance: float
    gauss: bool = False


def case(model, tolerance=1e-6):
    return Case(model.text(), model.node_columns, model.node_file, tolerance)


def punch(settings):
    """A block of 2 x 2 facets pressed onto a wider one of 3 x 3: meshes that do not match, and an edge of contact."""
    boxes = [
        Box("lower", "gel", (0.0, 0.0, 0.0), (1.5, 1.5, 1.0), (3, 3, 2)),
        Box("upper", "gel", (0.25, 0.25, 1.0), (1.0, 1.0, 1.0), (2, 2, 2)),
    ]
    mesh = replace(assemble(boxes), pairs={"joint": ("upper-bottom", "lower-top")})
    conditions = (fix("lower-bottom", "xyz"), fix("upper-top", "xy"), displace("upper-top", "z", -0.02, 1))
    materials = {"gel": Mixture(Solid(1.0), 1e-3)}
    ramp = (Curve(((0.0, 0.0), (1000.0, 1.0))),)
    joined = contacts(InterfaceType.BIPHASIC, mesh, settings)
    return Model("punch", "punch", "biphasic", mesh, materials, conditions, Control(5, 200.0), joined, ramp)


def elastic(model, tolerance=1e-6, kind="sliding-elastic"):
    """A biphasic model with its fluid taken away, in the module solid with a type that knows traction alone."""
    root = etree.fromstring(model.text().encode("iso-8859-1"))
    fluid = "Boundary/bc[@type='prescribed fluid pressure']"
    for path in ("Control//ptol", "Control//symmetric_stiffness", "Control//min_residual", fluid):
        for tag in root.iterfind(path):
            tag.getparent().remove(tag)
    root.find("Module").set("type", "solid")
    root.find("Control/solver").set("type", "solid")
    root.find("Control/analysis").text = "STATIC"
    for material in root.iterfind("Material/material"):
        solid = material.find("solid")
        material.set("type", solid.get("type"))
        material[:] = list(solid)
    for contact in root.iterfind("Contact/contact"):
        contact.set("type", kind)
        for tag in contact.findall("search_radius") if kind != "sliding-elastic" else ():
            contact.remove(tag)
    columns = model.node_columns[:6]
    root.find("Output/logfile/node_data").set("data", ";".join(columns))
    text = etree.tostring(root, encoding="iso-8859-1", xml_declaration=True).decode("iso-8859-1")
    return Case(text, columns, model.node_file, tolerance)


def traction_alone(model, kind, tolerance):
    """A biphasic model with a type that leaves its fluid alone: impermeable in contact and outside."""
    made = case(model, tolerance)
    return replace(made, text=made.text.replace('"sliding-biphasic"', f'"{kind}"'), gauss=True)


def held(model):
    """Pressure prescribed at nodes that are in contact throughout, where FEBio's type keeps it, too."""
    return replace(model, conditions=(*model.conditions, pressure("lower-top", 2e-3)))


CASES = {
    "pressure held in contact": case(held(confined(BIPHASIC))),
    "facet on facet": elastic(confined(ELASTIC), kind="sliding-facet-on-facet"),
    "facet on facet, value": elastic(confined(ContactSettings(penalty=50.0)), kind="sliding-facet-on-facet"),
    "node on facet": elastic(confined(ELASTIC), kind="sliding-node-on-facet"),
    "biphasic bodies, traction alone": traction_alone(punch(ELASTIC), "sliding-elastic", 5e-3),
    "biphasic bodies, facet on facet": traction_alone(confined(ELASTIC), "sliding-facet-on-facet", 1e-6),
    "elastic, automatic": elastic(confined(ELASTIC)),
    "elastic, value": elastic(confined(ContactSettings(penalty=50.0))),
    "elastic, two passes": elastic(confined(replace(ELASTIC, two_pass=True))),
    "elastic, AUGLAG": elastic(confined(ContactSettings(laugon="AUGLAG", penalty=50.0, gaptol=1e-7)), 2e-3),
    "elastic, edge of contact": replace(elastic(punch(ELASTIC), 5e-3), gauss=True),
    "biphasic, edge of contact": replace(case(punch(BIPHASIC), 5e-3), gauss=True),
    "biphasic, automatic": case(confined(BIPHASIC)),
    "biphasic, default": case(confined(ContactSettings())),
    "biphasic, value": case(confined(ContactSettings(penalty=100.0, pressure_penalty=0.1))),
    "solute, automatic": case(diffusion(InterfaceType.SOLUTE, STIFF)),
    "solute, default": case(diffusion(InterfaceType.SOLUTE, ContactSettings())),
    "solute, the paper's penalties": case(diffusion(InterfaceType.SOLUTE, PAPER)),
    "solute, AUGLAG": case(diffusion(InterfaceType.SOLUTE, augmented(PAPER, 1e-4)), 2e-3),
    "solute, two materials": case(Composite(InterfaceType.SOLUTE, elements=4, control=Control(5, 400.0)).model(), 1e-3),
    "solute, convection": case(Convection(InterfaceType.SOLUTE, STIFF, elements=4, control=Control(5, 400.0)).model()),
    "solute, two layers": case(Layers(InterfaceType.SOLUTE, elements=4, control=Control(5, 400.0)).model(), 1e-3),
    "solute, along the contact": case(Patches(InterfaceType.SOLUTE, STIFF, divided=False).model(), 1e-4),
    "multiphasic, automatic": case(diffusion(InterfaceType.MULTIPHASIC, STIFF)),
    "multiphasic, default": case(diffusion(InterfaceType.MULTIPHASIC, ContactSettings())),
    "multiphasic, AUGLAG": case(diffusion(InterfaceType.MULTIPHASIC, augmented(PAPER, 1e-4)), 2e-3),
}


def with_gauss_points(data):
    root = etree.fromstring(data)
    for contact in root.iterfind("Contact/contact"):
        etree.SubElement(contact, "integration").text = "gauss"
    return etree.tostring(root, encoding="iso-8859-1", xml_declaration=True)


def answer(path, chosen, plugin=None):
    finished = febio_runs.run(path, plugin=plugin)
    history = logdata.read_history(path.parent / chosen.file, chosen.columns)
    return finished, history


@pytest.mark.parametrize("name", CASES)
def test_the_answer_stays(runner, tmp_path, name):
    chosen = CASES[name]
    folders = [tmp_path / "before", tmp_path / "after"]
    for folder in folders:
        folder.mkdir()
    before, after = (folder / "model.feb" for folder in folders)
    before.write_text(chosen.text, encoding="iso-8859-1")
    after.write_bytes(with_gauss_points(convert(before).data) if chosen.gauss else convert(before).data)
    _, old = answer(before, chosen)
    _, new = answer(after, chosen, engine.required_plugin())
    for column in chosen.columns[3:]:
        scale = np.abs(old[column]).max()
        if scale > 0.0:
            assert np.abs(new[column] - old[column]).max() <= chosen.tolerance * scale, column


def in_folder(folder, text):
    folder.mkdir()
    path = folder / "model.feb"
    path.write_text(text, encoding="iso-8859-1")
    return path


def results(path, plugin=None):
    """What a run logs, and in how many iterations."""
    finished = febio_runs.run(path, plugin=plugin)
    logged = {file.name: file.read_bytes() for file in path.parent.glob("*.txt")}
    assert logged
    return finished.report.iterations, logged


def scene(name, folder):
    return SCENES[name].write(name, folder).read_text(encoding="iso-8859-1")


OLDER = ("node on facet", "elastic, two passes", "biphasic, edge of contact", "solute, the paper's penalties")
"""With conditions on displacement, pressure and concentration, and with load curves."""


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("name", [*OLDER, "rigid-slab", "shells-back", "quasi-newton"])
def test_older_formats_have_the_same_answer_to_the_digit(runner, tmp_path, name, version):
    text = CASES[name].text if name in CASES else scene(name, tmp_path)
    newest, old = in_folder(tmp_path / "4.0", text), in_folder(tmp_path / version, older(text, version))
    assert results(old) == results(newest)
    for path in (newest, old):
        path.write_bytes(convert(path).data)
    assert b"sliding-mixture" in old.read_bytes()
    assert results(old, engine.required_plugin()) == results(newest, engine.required_plugin())


@pytest.mark.parametrize("version", VERSIONS)
def test_instances_of_parts_have_the_same_answer_to_the_digit(runner, tmp_path, version):
    text = CASES["biphasic, edge of contact"].text
    newest, old = in_folder(tmp_path / "4.0", text), in_folder(tmp_path / version, in_instances(text, version))
    for path in (newest, old):
        path.write_bytes(convert(path).data)
    assert results(old, engine.required_plugin()) == results(newest, engine.required_plugin())


PLACEMENTS = (
    '<scale>0.5,2,1</scale><rotate type="vector">10,20,30</rotate><translate>1,2,3</translate>',
    '<rotate type="Euler">15,25,35</rotate><translate>-1,0,2</translate>',
    '<rotate type="quaternion">0.1,0.2,0.3,0.9</rotate>',
    "<rotate>0.2,0.4,0.6,1.8</rotate><scale>1,1,3</scale>",
    "<rotate>0,0,1,0</rotate>",
)
"""No unit quaternions among them, and one that FEBio takes for no rotation."""


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("number", range(len(PLACEMENTS)))
def test_instances_lie_where_febio_has_them(runner, tmp_path, version, number):
    chosen = CASES["biphasic, edge of contact"]
    placements = (PLACEMENTS[number], PLACEMENTS[number - 1])
    path = in_folder(tmp_path / version, in_instances(chosen.text, version, *placements))
    points = read(path).mesh.points
    _, history = answer(path, chosen)
    at_first = np.stack([history[axis][0] - history[f"u{axis}"][0] for axis in "xyz"], axis=1)
    assert np.abs(at_first - points).max() <= 1e-10 * np.abs(points).max()  # the digits of the log


@pytest.mark.parametrize("read_by", ['<Contact from="contact.feb"/>', "<Include>contact.feb</Include>"])
@pytest.mark.parametrize("version", [*VERSIONS, "4.0"])
def test_contacts_in_included_files_have_the_same_answer_to_the_digit(runner, tmp_path, version, read_by):
    text = CASES["biphasic, edge of contact"].text
    text = text if version == "4.0" else older(text, version)
    contact = re.search("<Contact>.*?</Contact>", text, re.DOTALL).group(0)
    whole = in_folder(tmp_path / "whole", text)
    path = in_folder(tmp_path / "pieces", text.replace(contact, read_by))
    piece = path.with_name("contact.feb")
    piece.write_text(f'<?xml version="1.0"?><febio_spec version="{version}">{contact}</febio_spec>')
    assert results(path) == results(whole)
    whole.write_bytes(convert(whole).data)
    made = convert(path)
    for file, data in {**made.included, path: made.data}.items():
        file.write_bytes(data)
    assert results(path, engine.required_plugin()) == results(whole, engine.required_plugin())
