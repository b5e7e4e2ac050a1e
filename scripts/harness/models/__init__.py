"""Finite element models as values: mesh, materials, conditions, contact and control, and their .feb files."""
