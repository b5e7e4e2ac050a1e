"""Sections of the formats 2.5 and 3.0 in the form that 4.0 gives them, for reading alone."""

from pathlib import Path

from harness.preflight import xml_file
from harness.preflight.formats import form_25, form_30
from harness.preflight.xml_file import AS_THEY_ARE, Contents, Document

_REWRITTEN = {"2.5": form_25.rewritten, "3.0": form_30.rewritten}


def read_newest(path: Path, instead: Contents = AS_THEY_ARE) -> Document:
    """Read a model file and what it includes; what `instead` has is read in place of files.

    Raises ModelError: as `xml_file.read`; what cannot be read in an older format.
    """
    document = xml_file.read(path, instead)
    rewritten = _REWRITTEN.get(document.version)
    return rewritten(document) if rewritten else document
