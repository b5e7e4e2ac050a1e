"""The comment at the head of each model file."""

from __future__ import annotations

from harness.models.interface import InterfaceType

UNITS = """\
Units: mm, N, s, nmol, K. Hence stress and pressure in MPa, concentration in mM = nmol/mm^3, permeability in
mm^4/(N s), diffusivity in mm^2/s; R = 8.314e-6 mJ/(nmol K)."""


def header(name: str, about: str, interface: InterfaceType) -> str:
    """What the model shows, its units, and the command that runs it.

    Parameters
    ----------
    name : str
        Stem of the file.
    about : str
        What it shows, one or more paragraphs.
    interface : InterfaceType
        Decides whether the command loads the plugin.
    """
    load = " -import build/lib/libFEBioMixtureContact.so" if interface.needs_plugin else ""
    run = f"Run it: scripts/mixcontact run models/{name}.feb\nor:     febio4 -i models/{name}.feb{load}"
    return f"{about}\n\n{UNITS}\n\n{run}"
