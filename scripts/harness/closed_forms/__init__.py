"""Closed forms that the models are compared with, one module for each problem.

Every function takes and returns plain numbers and NumPy arrays, in the units of the package (mm, N, s, nmol).
"""
