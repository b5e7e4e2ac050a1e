"""Scenes drawn from the kinds that users report: bodies, the contact between them, loads and a solver each."""
