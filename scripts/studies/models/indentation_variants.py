"""Meshes of problem 3.3."""

from __future__ import annotations

from harness.models.indentation_mesh import Grid

LEVELS = (
    Grid(across=9, down=6, around=3),
    Grid(),
    Grid(across=36, down=24, around=12),
)
"""Three meshes, each with half the element size of the one before."""
