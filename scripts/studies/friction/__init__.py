"""Friction: its hard cases, published curves beside runs, and what settings cost."""
