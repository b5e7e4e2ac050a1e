"""The gallery: models to start from, their pictures, curves and run times."""
