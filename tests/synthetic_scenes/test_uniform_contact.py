"""Where contact is uniform, a converted model with the same penalty in numbers gives what FEBio's interface gives."""

from __future__ import annotations

import febio_runs
import numpy as np
import pytest

from harness.conversion import convert
from harness.run import engine
from studies.models import small
from studies.models.small import Document, Parts, biphasic, contact, control, curve, elastic, fixed, moved

PENALTY = "<laugon>{laugon}</laugon><auto_penalty>0</auto_penalty><penalty>100</penalty>"
"""MPa/mm, which leaves an overlap of a few thousandths of an element."""
BAR = 1e-8


def compressed(kind: str, params: str, *, porous: bool) -> Document:
    """Two blocks of one mesh on one another, between smooth walls."""
    parts = Parts()
    parts.box("low", (0, 0, 0), (1, 1, 1), (2, 2, 2), "one")
    parts.box("up", (0, 0, 1), (1, 1, 2), (2, 2, 2), "two")
    module, material = ("biphasic", biphasic) if porous else ("solid", elastic)
    drained = [f'<bc type="zero fluid pressure" node_set="{name}"/>' for name in ("low-bottom", "up-top")]
    scheme = control(module, 4, 0.25, analysis="TRANSIENT" if porous else "STATIC")
    return Document(
        parts.mesh({"pair": ("up-bottom", "low-top")}),
        (material("one", 1, 1.0), material("two", 2, 2.0)),
        module=module,
        control=scheme.replace("<max_refs>", "<dtol>1e-7</dtol><rtol>1e-12</rtol><max_refs>"),
        boundary=(
            fixed("low-bottom", "z"),
            *(fixed(f"{body}-{side}", "x") for body in ("low", "up") for side in ("left", "right")),
            *(fixed(f"{body}-{side}", "y") for body in ("low", "up") for side in ("front", "back")),
            moved("up-top", "z", -0.1),
            *(drained if porous else ()),
        ),
        contacts=(contact("c", "pair", kind, params),),
        curves=(curve(1, (0, 0), (1, 1)),),
        node_data="ux;uy;uz;p" if porous else "ux;uy;uz",
    )


@pytest.mark.parametrize(
    ("kind", "params"),
    [
        ("sliding-elastic", PENALTY.format(laugon="PENALTY")),
        ("sliding-facet-on-facet", PENALTY.format(laugon="PENALTY")),
        ("sliding-biphasic", PENALTY.format(laugon="PENALTY") + "<pressure_penalty>0.01</pressure_penalty>"),
    ],
)
def test_uniform_contact_is_that_of_febio(runner, tmp_path, kind, params):
    (tmp_path / "febio").mkdir()
    (tmp_path / "ours").mkdir()
    original, converted = tmp_path / "febio" / "model.feb", tmp_path / "ours" / "model.feb"
    original.write_text(compressed(kind, params, porous=kind == "sliding-biphasic").text())
    converted.write_bytes(convert.convert(original).data)
    assert febio_runs.run(original, plugin=None).report.normal
    assert febio_runs.run(converted, plugin=engine.required_plugin()).report.normal
    theirs, ours = (small.table(path.parent / "nodes.txt")[-1] for path in (original, converted))
    size = np.concatenate([np.full(3, np.abs(theirs[:, :3]).max()), np.abs(theirs[:, 3:]).max(axis=0)])
    np.testing.assert_array_less(np.abs(ours - theirs).max(axis=0), BAR * size)
