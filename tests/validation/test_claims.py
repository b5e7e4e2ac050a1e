"""What README and the pages claim is what the data say, read here without the code that writes the pages."""

from __future__ import annotations

import csv
import json
import re
from statistics import median

import pytest

from harness.paths import DOCS, REPOSITORY
from studies.pages import front
from studies.stamps import LIMIT, NEARLY

DATA = DOCS / "data"
OURS = "sliding-mixture"


def rows(name: str) -> list[dict[str, str]]:
    """A table of docs/data."""
    lines = (DATA / name).read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def scenes(name: str) -> list[dict]:
    """The rows of a JSON file of docs/data."""
    return json.loads((DATA / name).read_text(encoding="utf-8"))["rows"]


def claim(page: str) -> str:
    """The headline of a page of evidence, which README quotes, and the paragraph below it."""
    said = front.said_first(f"docs/evidence/{page}.md")
    assert said in (REPOSITORY / "README.md").read_text(encoding="utf-8")
    text = (DOCS / "evidence" / f"{page}.md").read_text(encoding="utf-8")
    return f"{said} {text.split(f'**{said}**')[1].split(chr(10) * 2)[1]}"


def text_of_the_documentation() -> str:
    pages = [path for path in DOCS.rglob("*.md") if path.name != "changelog.md"]
    return "\n".join(path.read_text(encoding="utf-8") for path in (*pages, REPOSITORY / "README.md"))


@pytest.mark.parametrize("words", ["real model", "gives the old answer", "real scenes"])
def test_words_that_claim_more_than_is_known_are_gone(words):
    assert words not in text_of_the_documentation().lower()


def test_hard_cases_say_which_misses_are_technical_and_which_cases_are_one_scene():
    own = [row for row in rows("hard-cases.csv") if row["interface"] == "febio-1000"]
    missing = [row["missed"] for row in own if row["ended"] == "True" and row["missed"]]
    further = [missed for missed in missing if missed.startswith("a further run")]
    said = claim("hard-cases")
    assert f"misses checks in {len(missing)}." in said
    assert f"A further run for the check failed or could not be compared in {len(further)}." in said
    assert any("2.9e-09" in missed for missed in missing) == (
        "The missed difference is below 1e-06 in 1 of these 7." in said
    )
    assert "`units` and `restart`" in said
    assert "`curved-1-to-8` and `curved-two-pass`" in said


def test_cost_says_whose_run_is_the_faster_at_the_same_error():
    said = claim("cost")
    assert "non-symmetric" in said
    for problem in ("3.1", "3.2"):
        own = [row for row in rows("cost.csv") if row["problem"] == problem and row["ended"] == "True"]
        varied = [row for row in own if row["parameter"] not in ("elements", "steps")]
        ours = next(row for row in own if (row["interface"], row["parameter"]) == (OURS, "default"))
        bar = 2.0 * float(ours["contact_error"])
        good = [row for row in varied if row["interface"] != OURS and float(row["contact_error"]) <= bar]
        fastest = min(float(row["ratio"]) for row in good)
        part = said.split(f"in problem {problem}. They")[1].split("The defaults")[0].strip()
        faster = "FEBio's interface" if fastest < float(ours["ratio"]) else "`sliding-mixture`"
        assert f"{fastest:.2f} times the time of one body" in part
        assert part.endswith(f"{faster} is faster.")
        theirs = "more" if "mixture" in faster else "less"
        assert re.search(
            rf"settings of FEBio's interfaces take {theirs} time in problems? (?:[\d.]+ and )*{problem}\b", said
        )


def test_the_predictor_has_a_column_of_its_own_in_the_table_of_costs():
    table = (DOCS / "reference" / "runs.md").read_text(encoding="utf-8").split("## Least time for an error")[1]
    lines = [line.split(" | ") for line in table.splitlines() if line.startswith("| 3.")]
    assert len(lines) > 10
    assert not any("predictor" in cell for line in lines for cell in line[:-1])


def test_the_price_names_the_largest_share_of_its_table():
    most = max(float(row["share"]) for row in rows("price-effects.csv"))
    assert f"takes at most {100.0 * most:.1f} % of a run's time" in claim("price")


def test_the_price_says_what_febios_default_matrix_changes():
    found = {(row["scene"], row["form"]): row for row in rows("price-matrices.csv")}
    default = {scene: row for (scene, form), row in found.items() if form == "symmetric"}
    ours = {row["scene"]: row for row in rows("price-joints.csv") if row["type"] == OURS}
    ended = [scene for scene, row in default.items() if row["ended"] == "True"]
    faster = sum(float(ours[scene]["ratio"]) > float(default[scene]["ratio"]) for scene in ended)
    said = claim("price")
    assert f"completes {len(ended)} of the {len(default)} joints without a fluid" in said
    assert said.endswith(f"is then faster than `sliding-mixture` in {faster or 'none'} of them.")


def test_verification_counts_what_has_a_tolerance_and_says_what_has_none():
    sections = json.loads((DATA / "verification.json").read_text(encoding="utf-8"))["sections"]
    measures = [measure for section in sections for measure in section["measures"]]
    near = sum(m["value"] > 0.5 * m["tolerance"] for m in measures if m["tolerance"])
    said = claim("verification")
    assert f"of {len(measures)} results" in said
    assert f"{near} results use more than half of their tolerance" in said
    assert "Hertz's contacts have no tolerance" in said
    page = (DOCS / "evidence" / "verification.md").read_text(encoding="utf-8")
    for title, model in (
        ("cylinder and a sphere differ", r"^\| (?:cylinder|sphere), \d+ elements \|"),
        ("asymptotic", r"^\| (?:line|sphere), \d+ by"),
    ):
        lines = [line for line in page.splitlines() if re.match(model, line)]
        most = max(float(cell.split(" %")[0]) for line in lines for cell in line.split(" | ")[1:])
        assert re.search(rf"{title}.*?up to {most:.1f} %", said)


def test_the_limit_ended_only_what_took_its_time():
    cost = [row for row in rows("cost.csv") if row["ended"] == "False"]
    for interface in ("sliding-biphasic-solute", "sliding-multiphasic"):
        own = [row for row in cost if row["interface"] == interface]
        stopped = sum(float(row["cpu"]) >= NEARLY * LIMIT for row in own)
        told = f" ({stopped} of them at the limit)" if stopped else ""
        page = (DOCS / "evidence" / "cost.md").read_text(encoding="utf-8")
        assert re.search(rf"{len(own)} of \d+ with `{interface}`{re.escape(told)}[,.]", page)
    for name in ("hard-cases.csv", "friction-cases.csv", "price-comparison.csv"):
        assert not any(row["limited"] == "True" and row["ended"] == "True" for row in rows(name))


def test_the_synthetic_scenes_say_by_how_much_answers_differ():
    own = [
        row["converted"]
        for row in scenes("synthetic-scenes.json")
        if row["febio"]["ended"] and row["converted"]["ended"]
    ]
    apart = median(took["difference"] for took in own)
    fields = [took["of_fields"] for took in own if took["of_fields"] == took["of_fields"]]
    page = (DOCS / "evidence" / "synthetic-scenes.md").read_text(encoding="utf-8")
    assert f"is {100.0 * apart:.1f} % of the largest displacement in the median" in page
    span = f"{100.0 * min(fields):.0f} % to {100.0 * max(fields):.0f} %"
    assert f"{span} of its largest value in {len(fields)} porous scenes" in page


def test_reported_scenes_count_what_ends_and_what_takes_more():
    rows = scenes("reported-scenes.json")
    sound = [row for row in rows if row["febio"]["ended"]]
    said = claim("reported-scenes")
    assert f"FEBio's interface completes {len(sound)} of {len(rows)} scenes" in said
    for way, title in (("converted", "converted"), ("defaults", "penalties deleted")):
        ended = [row for row in sound if row[way]["ended"]]
        others = sum(row[way]["ended"] for row in rows) - len(ended)
        more = sum(row[way]["retries"] > row["febio"]["retries"] for row in ended)
        assert re.search(rf"\| {title} \| {len(ended)} \| {others} \|.*\| {more} \|", said)
        if way == "converted":
            assert f"Converted models complete {len(ended)} of these and {others} others." in said


def test_agreement_counts_in_which_quantities_the_converted_model_is_nearer():
    coarse = [row for row in scenes("agreement.json") if row["fineness"] == 1]
    found = {(row["scene"], row["quantity"], row["interface"]): row for row in coarse}
    pairs = [
        (row, found[scene, quantity, "converted"])
        for (scene, quantity, who), row in found.items()
        if who != "converted"
    ]
    whole = [(febio, ours) for febio, ours in pairs if febio["rms"] != febio["rms"]]
    numbers = [(febio["error"], ours["error"]) for febio, ours in whole if "facets" not in febio["quantity"]]
    fields = [(febio["rms"], ours["rms"]) for febio, ours in pairs if febio["rms"] == febio["rms"]]
    said = claim("agreement")
    for name, errors in (("forces, approaches, areas and contents", numbers), ("fields (L2)", fields)):
        nearer = sum(ours < febio for febio, ours in errors)
        assert f" {nearer} of {len(errors)} {name}" in said
    assert f"in {sum(a < b for a, b in [*numbers, *fields])} of {len(numbers) + len(fields)} quantities" in said
    nearer = sum(ours < febio for febio, ours in numbers)
    text = (DOCS / "faq.md").read_text(encoding="utf-8") + (DOCS / "start" / "convert.md").read_text(encoding="utf-8")
    text += (REPOSITORY / "README.md").read_text(encoding="utf-8")
    phrases = ("answer on a coarse mesh is often nearer", "interface on a coarse mesh is often nearer")
    phrases += ("FEBio's interface is often nearer to the fine-mesh answer",)
    assert all(phrase in text for phrase in phrases) == (2 * nearer < len(numbers))
