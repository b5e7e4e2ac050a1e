"""Scenes written here of what models of users hold, with FEBio's interface and, converted, with sliding-mixture."""
