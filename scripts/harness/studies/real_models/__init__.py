"""Scenes of the breadth that users have, with FEBio's interface and, converted, with sliding-mixture."""
