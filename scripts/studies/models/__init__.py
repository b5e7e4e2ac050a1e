"""Models of studies alone, as values."""
