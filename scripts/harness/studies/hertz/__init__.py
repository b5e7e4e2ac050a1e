"""Biphasic Hertz contact along a line: two meshes and draining surfaces beside the closed form of thin layers."""
