"""The page of what the contact costs: docs/evidence/price.md, with its picture, from docs/data/price-*.csv."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from studies import files, tables
from studies.pages.evidence import DATA, EvidencePage
from studies.price import febio_matrices, joints
from studies.price.febio_matrices import Matrix
from studies.price.joints import JointPrice
from studies.price.paired_runs import Price
from studies.price.scenes import effects_added
from studies.price.table import EffectCost

JOINTS, EFFECTS, COMPARISON = "price-joints.csv", "price-effects.csv", "price-comparison.csv"
MATRICES = "price-matrices.csv"
PICTURE = "images/price.svg"
ASKED = (
    '<material type="neo-Hookean">',
    '<material type="biphasic">',
    '<material type="multiphasic">\n  <solute sol="1">',
    '<material type="multiphasic">\n  <solute sol="1"> <solute sol="2">',
    '<material type="multiphasic">\n  <solute sol="1"> ... <solute sol="4">',
    '... <solute sol="1">\n<bc type="zero displacement">',
)
"""The XML that asks for what each scene exchanges, in their order."""
GREYS = {"shared": ("#f2f2f2", ""), "traction": ("#c2ccd9", ""), "solvent": ("#8aa3c2", "")}
SOLUTES = (("#4f74a3", ""), ("#35557d", ""), ("#4f74a3", "///"), ("#35557d", "///"))
"""Colours that are told apart in grey, and hatching."""


def figures() -> Mapping[str, str]:
    """What the text of the page leaves open."""
    costs = files.read_csv(DATA / EFFECTS, EffectCost)
    prices = files.read_csv(DATA / COMPARISON, Price)
    matrices = files.read_csv(DATA / MATRICES, Matrix)
    measured = joints.arranged(files.read_csv(DATA / JOINTS, JointPrice))
    return {
        "headline": joints.headline(measured),
        "details": f"{joints.details(measured)} {_details(costs)} {febio_matrices.headline(matrices, measured)}",
        "matrices": febio_matrices.matrices_table(matrices, measured),
        "joints": joints.joints_table(measured),
        "facets": str(next(iter(effects_added().values())).section),
        "effects": "\n".join(_scene(own) for own in _by_scene(costs).values()),
        "comparison": comparison_table(prices),
    }


def _by_scene(costs: Sequence[EffectCost]) -> dict[str, list[EffectCost]]:
    return tables.grouped(costs, lambda cost: cost.scene)


def _details(costs: Sequence[EffectCost]) -> str:
    scenes = list(_by_scene(costs).values())
    most = max((own[0] for own in scenes), key=lambda cost: cost.share)
    return (
        f"The contact of thin blocks takes at most {_percent(most.share)} of a run's time (`{most.scene}`). An absent "
        "effect adds no unknown, no matrix entry and no call."
    )


def _percent(part: float) -> str:
    return f"{100.0 * part:.1f} %"


def _scene(own: Sequence[EffectCost]) -> str:
    first = own[0]
    share = f"{_percent(first.share)} ({_percent(first.share_low)} to {_percent(first.share_high)})"
    cells = (share, first.unknowns, first.entries, first.bytes)
    return f"| {first.scene} | {' | '.join(map(str, cells))} |"


def draw(costs: Sequence[EffectCost], path: Path) -> Path:
    """Bars of time by effect and of matrix entries, a row for each scene, with the XML that asks for it."""
    figure = Figure(figsize=(5.4, 7.4), layout="constrained", facecolor="white")
    upper, lower = figure.subplots(2, 1, sharey=True)
    scenes = list(_by_scene(costs).values())
    for row, own in enumerate(scenes):
        _bar(upper, row, own)
        lower.barh(row, own[0].entries / 1e3, color="#8aa3c2", edgecolor="black", linewidth=0.5, height=0.6)
        lower.text(own[0].entries / 1e3, row, f" {own[0].unknowns} unknowns", va="center", fontsize=9)
    upper.invert_yaxis()
    upper.set_xlabel("time in the contact, part of the run [%]")
    lower.set_xlabel("matrix entries [thousands]")
    lower.margins(x=0.55)
    for axes in (upper, lower):
        axes.set_yticks(range(len(scenes)), ASKED[: len(scenes)], family="monospace", fontsize=8)
        axes.spines[["top", "right"]].set_visible(False)
    handles, labels = upper.get_legend_handles_labels()
    unique = dict(zip(labels, handles, strict=True))
    figure.legend(unique.values(), unique.keys(), loc="outside upper center", ncols=4, fontsize=9, frameon=False)
    return files.save_figure(figure, path)


def _bar(axes: Axes, row: int, own: Sequence[EffectCost]) -> None:
    """A stacked bar, with the least and the largest share of repeated runs."""
    at = 0.0
    for cost in own:
        colour, hatch = GREYS.get(cost.effect) or SOLUTES[int(cost.effect.split()[-1]) - 1]
        width = 100.0 * cost.part
        (bar,) = axes.barh(row, width, left=at, label=cost.effect, color=colour, ec="black", lw=0.5, height=0.6)
        bar.set_hatch(hatch)
        at += width
    first = own[0]
    span = [[100.0 * (first.share - first.share_low)], [100.0 * (first.share_high - first.share)]]
    axes.errorbar(100.0 * first.share, row, xerr=span, fmt="none", ecolor="black", elinewidth=0.9, capsize=2.5)


def comparison_table(prices: Sequence[Price]) -> str:
    """Ours beside FEBio's, as Markdown, with whether FEBio's or ours without the predictor adds less."""
    heads = ("bodies", "contact", "penalties", "iterations", "unknowns", "matrix entries", "added", "adds less")
    rows = []
    ours = {price.kind: price for price in prices if price.type == joints.OURS}
    for price in prices:
        penalties = f"factor {price.factor:g}" if price.factor else "defaults"
        told = (price.iterations, price.unknowns, price.entries)
        counts = told if price.ended else (joints.unended(price.limited), "", "")
        less = _less(ours[price.kind], price)
        contact = f"`{joints.OURS}`, `predictor` 1" if price.type == joints.PREDICTED else f"`{price.type}`"
        rows.append((price.kind, contact, penalties, *map(str, counts), _added(price), less))
    return tables.markdown(heads, rows)


def _added(price: Price) -> str:
    if not price.ended:
        return ""
    return f"{100 * price.added:.0f} % ({100 * price.added_low:.0f} to {100 * price.added_high:.0f})"


def _less(ours: Price, price: Price) -> str:
    if price.type in (joints.OURS, joints.PREDICTED):
        return ""
    return f"`{price.type if price.ended and price.added < ours.added else ours.type}`"


PAGE = EvidencePage("evidence/price.md", (JOINTS, EFFECTS, COMPARISON), Path(__file__).with_name("page.md"), figures)
