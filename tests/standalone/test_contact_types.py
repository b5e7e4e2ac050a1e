"""The types and parameters that Python knows are those of the code."""

from __future__ import annotations

import pytest

from harness.errors import EngineNotFoundError
from harness.preflight.plugin_types import FILE
from studies.pages import plugin_parameters


def test_the_file_of_types_is_what_the_engine_prints() -> None:
    """Where this fails: write what `build/bin/mixture-contact --contact-types` prints into the file."""
    try:
        printed = plugin_parameters.printed()
    except EngineNotFoundError as error:
        pytest.skip(str(error))
    assert FILE.read_text(encoding="utf-8") == printed
