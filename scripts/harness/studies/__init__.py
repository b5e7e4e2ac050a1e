"""Measurements over many runs: hard cases, cost and accuracy, times, fuzzing."""
