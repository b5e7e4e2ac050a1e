"""Switches a model from FEBio's sliding interfaces to `sliding-mixture`, byte for byte the same elsewhere."""
