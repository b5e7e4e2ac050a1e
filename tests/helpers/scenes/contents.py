"""What hexahedra of `scenes.tied_columns.mixed` hold, from logged displacements, pressures and concentrations."""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from harness.models.parts import GAS_CONSTANT, TEMPERATURE
from harness.post.hexahedra import geometry
from studies.models.small import Document

Array = NDArray[np.float64]

SOLID = 0.2
"""Volume of the solid over that of the reference configuration."""


class Soaked:
    """Elements of a model at the times of its log.

    Attributes
    ----------
    volumes : ndarray, shape (n_elements, n_points)
        Of the reference configuration, mm^3.
    stretch : ndarray, shape (n_times, n_elements, n_points)
        J.
    pressure : ndarray
        p = p~ + R T c, MPa.
    solute : ndarray, shape (n_times, n_elements)
        Amount in each element, nmol.
    """

    def __init__(self, document: Document, nodes: Array) -> None:
        places = np.array([_numbers(text) for text in re.findall(r"<node [^>]*>([^<]*)<", document.mesh)])
        elements = np.array([_numbers(text) for text in re.findall(r"<elem [^>]*>([^<]*)<", document.mesh)], int) - 1
        reference = geometry(places, elements)
        present = [geometry(places + state[:, :3], elements) for state in nodes]
        pressure, concentration = (
            np.array([made.at_points(state[elements, k]) for made, state in zip(present, nodes, strict=True)])
            for k in (3, 4)
        )
        self.volumes = reference.volumes
        self.stretch = np.array([made.volumes for made in present]) / reference.volumes
        self.pressure = pressure + GAS_CONSTANT * TEMPERATURE * concentration
        self.solute = ((self.stretch - SOLID) * concentration * reference.volumes).sum(axis=2)

    def work_on_fluid(self) -> Array:
        """Work that the solid has done on the fluid until each time, the integral of -p dJ, mJ."""
        mean = 0.5 * (self.pressure[1:] + self.pressure[:-1])
        steps = -(mean * np.diff(self.stretch, axis=0) * self.volumes).sum(axis=(1, 2))
        return np.concatenate([[0.0], np.cumsum(steps)])


def _numbers(text: str) -> list[float]:
    return [float(number) for number in text.split(",")]
