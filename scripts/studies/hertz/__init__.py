"""Hertz contacts on two meshes beside closed forms: of elastic bodies, and of thin biphasic layers along a line."""
