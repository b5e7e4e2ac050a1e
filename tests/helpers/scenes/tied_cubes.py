"""Two cubes that are tied across meshes that do not match, as text of a few parts."""

from __future__ import annotations

from studies.models.small import Document, Parts, contact, elastic, fixed, moved


def joint(
    params: str = "", *, kind: str = "tied-mixture", gap: float = 0.0, cells: tuple[int, int] = (2, 3)
) -> Document:
    """Two cubes that are tied."""
    parts = Parts()
    parts.box("low", (0, 0, 0), (1, 1, 1), (cells[0], cells[0], 1), "low")
    parts.box("up", (0, 0, 1 + gap), (1, 1, 2 + gap), (cells[1], cells[1], 1), "up")
    return Document(
        parts.mesh({"pair": ("up-bottom", "low-top")}),
        (elastic("low", 1), elastic("up", 2)),
        boundary=(fixed("low-bottom", "x", "y", "z"), moved("up-top", "z", 0.1)),
        contacts=(contact("tie", "pair", kind, params),),
    )
