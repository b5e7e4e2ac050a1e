"""Scenes in which contact is known to fail: models, physical checks, and FEBio's own interfaces as the reference."""
