"""Engines, their logs and data, and the runner that runs each model once."""
