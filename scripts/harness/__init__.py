"""Make models, run febio4 on them, read what it wrote, compare with closed forms and draw the comparison.

Units throughout: mm, N, s, nmol, hence MPa and mM (= nmol/mm^3).
"""
