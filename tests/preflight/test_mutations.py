"""Files that are broken at random: findings or a clear error, never a crash."""

from __future__ import annotations

import random
import re

import pytest
from older_formats import VERSIONS, in_instances, older
from scenes.ambient import Apart
from scenes.pairs import of_kinds

from harness.conversion.convert import convert
from harness.errors import ModelError
from harness.models.diffusion import Diffusion
from harness.models.interface import PAPER, InterfaceType
from harness.preflight.check import check
from harness.run import febfile
from studies.models.sheared_blocks import Kind

FILES = 400
SEED = 20120103
WORDS = ("", "nan", "inf", "-1", "0", "1e300", "much", "1:99999999999", "é", "<", "&amp;", "2,3", "x" * 5000)


def bases():
    joins = (InterfaceType.MIXTURE, InterfaceType.SOLUTE)
    models = [Diffusion(interface, PAPER, elements=2).model() for interface in joins]
    models += [Apart(InterfaceType.MULTIPHASIC).model(), of_kinds(Kind.RIGID, Kind.BIPHASIC).model()]
    texts = [model.text() for model in models]
    texts += [older(text, version) for text in texts for version in VERSIONS]
    return [*texts, in_instances(texts[0], "2.5", "<scale>1,1,1</scale>", "<rotate>0,0,0,1</rotate>")]


def drop_element(text, dice):
    found = [(m.group(1), m.start()) for m in re.finditer(r"<(\w+)[ >]", text)]
    if not found:
        return text
    name, start = dice.choice(found)
    stop = text.find(f"</{name}>", start)
    return text[:start] + text[stop + len(name) + 3 :] if stop > 0 else text[:start]


def change_value(text, dice):
    spots = [m.span(1) for m in re.finditer(r">([^<>\n]+)<", text)]
    start, stop = dice.choice(spots)
    return text[:start] + dice.choice(WORDS) + text[stop:]


def change_attribute(text, dice):
    spots = [m.span(1) for m in re.finditer(r'="([^"]*)"', text)]
    start, stop = dice.choice(spots)
    return text[:start] + dice.choice(WORDS) + text[stop:]


def drop_attribute(text, dice):
    start, stop = dice.choice([m.span() for m in re.finditer(r' \w+="[^"]*"', text)])
    return text[:start] + text[stop:]


def rename_tag(text, dice):
    name = dice.choice(sorted(set(re.findall(r"<(\w+)", text))))
    return re.sub(rf"(</?){name}\b", rf"\g<1>{name}x", text)


def cut_off(text, dice):
    return text[: dice.randrange(len(text))]


def swap_lines(text, dice):
    lines = text.splitlines()
    a, b = dice.randrange(len(lines)), dice.randrange(len(lines))
    lines[a], lines[b] = lines[b], lines[a]
    return "\n".join(lines)


def noise(text, dice):
    at = dice.randrange(len(text))
    return text[:at] + "".join(chr(dice.randrange(32, 127)) for _ in range(5)) + text[at:]


KINDS = (drop_element, change_value, change_attribute, drop_attribute, rename_tag, cut_off, swap_lines, noise)


def complaint(path, command):
    """What a command says of a file that it cannot use; empty where it can."""
    try:
        command(path)
    except ModelError as error:
        return str(error)
    return ""


@pytest.mark.parametrize("command", [check, convert, febfile.inspect])
@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_mutated_files(tmp_path, kind, command):
    path = tmp_path / "model.feb"
    texts, complaints = bases(), []
    for number in range(FILES // len(KINDS)):
        dice = random.Random(SEED + number)
        changed = texts[number % len(texts)]
        for _ in range(dice.choice((1, 1, 3))):
            changed = kind(changed, dice) or "x"
        path.write_text(changed, encoding="utf-8")
        complaints.append(complaint(path, command))
    assert any(complaints)
    assert all("model.feb" in said and len(said) < 1000 for said in complaints if said)
