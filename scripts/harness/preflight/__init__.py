"""Reads a model file before it is run and predicts trouble with its sliding contacts."""
