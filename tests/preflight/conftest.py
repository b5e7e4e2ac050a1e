"""Models with one fault each, and what `check` is to say of them. Nothing here needs FEBio."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from harness.models.document import Model
from harness.preflight.check import check
from harness.preflight.finding import Finding


@pytest.fixture
def findings(tmp_path: Path) -> Callable[..., list[Finding]]:
    """Findings of a model, or of a changed text of it."""

    def look(model: Model | str, *changes: tuple[str, str]) -> list[Finding]:
        text = model if isinstance(model, str) else model.text()
        for old, new in changes:
            assert old in text, f"there is no {old} to change"
            text = text.replace(old, new)
        path = tmp_path / "model.feb"
        path.write_text(text, encoding="iso-8859-1")
        return check(path)

    return look
