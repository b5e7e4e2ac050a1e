"""Models that serve tests alone, and what is measured of their runs."""
