"""Sections of the formats 2.5 and 3.0 in the form that 4.0 gives them, for reading alone."""
