"""The types and parameters that Python knows are those of the code."""

from __future__ import annotations

import subprocess

import pytest

from harness.errors import EngineNotFoundError
from harness.preflight.plugin_types import FILE
from harness.run import hosts


def test_the_file_of_types_is_what_the_engine_prints() -> None:
    """Where this fails: write what `build/bin/mixture-contact --contact-types` prints into the file."""
    try:
        printed = subprocess.run(
            [hosts.find_standalone(), "--contact-types"], check=True, capture_output=True, text=True
        )
    except EngineNotFoundError as error:
        pytest.skip(str(error))
    assert FILE.read_text(encoding="utf-8") == printed.stdout
