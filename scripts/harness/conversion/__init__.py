"""Switches a model from FEBio's sliding and tied interfaces to the plugin's, byte for byte the same elsewhere."""
