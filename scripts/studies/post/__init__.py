"""Numbers that studies alone take from what a run wrote."""
