"""The contact as a class of pyfebio."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from types import SimpleNamespace
from typing import get_args

import febio_runs
import pytest
from lxml import etree

from harness.preflight.plugin_types import PLUGIN_TYPES
from harness.run import engine
from studies.models.pressed_blocks import PressedBlocks

ATTRIBUTES = {"type", "name", "surface_pair"}


@pytest.fixture
def classes() -> SimpleNamespace:
    """The module, whose library Python 3.11 or newer has."""
    pytest.importorskip("pyfebio", reason="the library of scripts/requirements-report.txt")
    return SimpleNamespace(**vars(import_module("harness.ecosystem.pyfebio_contact")))


def test_it_has_the_parameters_of_the_plugin(classes: SimpleNamespace) -> None:
    table = {each.name for each in PLUGIN_TYPES["sliding-mixture"] if each.group}
    assert set(classes.SlidingMixture.model_fields) - ATTRIBUTES == table


def test_values_with_names_are_those_of_the_plugin(classes: SimpleNamespace) -> None:
    fields = classes.SlidingMixture.model_fields
    for parameter in PLUGIN_TYPES["sliding-mixture"]:
        if parameter.choices:
            literal = get_args(fields[parameter.name].annotation)[0]
            assert get_args(literal) == parameter.choices


def test_nothing_is_written_that_was_not_given(classes: SimpleNamespace) -> None:
    written = etree.fromstring(classes.SlidingMixture(surface_pair="joint").to_xml(skip_empty=True))
    assert len(written) == 0
    assert dict(written.attrib) == {"type": "sliding-mixture", "surface_pair": "joint"}


def test_values_may_follow_load_curves(classes: SimpleNamespace) -> None:
    contact = classes.SlidingMixture(
        surface_pair="joint",
        penalty=2.0,
        ambient_pressure=classes.Varying(text=-1e-3, lc=2),
        ambient_concentration=[classes.AmbientConcentration(text=0.5, sol=1, lc=3)],
    )
    written = etree.fromstring(contact.to_xml(skip_empty=True))
    assert [(each.tag, float(each.text), dict(each.attrib)) for each in written] == [
        ("penalty", 2.0, {}),
        ("ambient_pressure", -1e-3, {"lc": "2"}),
        ("ambient_concentration", 0.5, {"lc": "3", "sol": "1"}),
    ]


@pytest.mark.parametrize("wrong", [{"penalty": "stiff"}, {"laugon": "BEST"}, {"penalti": 1.0}, {"two_pass": 2}])
def test_wrong_values_are_refused_by_name(classes: SimpleNamespace, wrong: dict[str, object]) -> None:
    with pytest.raises(ValueError, match=next(iter(wrong))):
        classes.SlidingMixture(surface_pair="joint", **wrong)


def test_a_model_holds_it_with_contacts_of_febio(classes: SimpleNamespace) -> None:
    febio = import_module("pyfebio.contact")
    model = classes.MixtureModel()
    model.contact_.add_contact(classes.SlidingMixture(surface_pair="joint", fric_coeff=0.02))
    model.contact_.add_contact(febio.SlidingElastic(surface_pair="other"))
    written = etree.fromstring(model.to_xml(skip_empty=True))
    assert [each.get("type") for each in written.iter("contact")] == ["sliding-mixture", "sliding-elastic"]
    assert written.find("Contact/contact").get("name") == "sliding-mixture_1"


def test_febio_reads_it(classes: SimpleNamespace, runner, tmp_path: Path) -> None:
    scene = PressedBlocks(lower=1, upper=1, through=1, name="pressed").model()
    root = etree.fromstring(scene.text().encode())
    section = root.find("Contact")
    pair = section[0].get("surface_pair")
    made = classes.MixtureContact()
    made.add_contact(classes.SlidingMixture(surface_pair=pair, laugon="AUGLAG", tolerance=0.01, two_pass=0))
    root.replace(section, etree.fromstring(made.to_xml(skip_empty=True)))
    file = tmp_path / "pressed.feb"
    file.write_bytes(etree.tostring(root, encoding="ISO-8859-1", xml_declaration=True))
    assert febio_runs.run(file, plugin=engine.required_plugin()).report.normal
