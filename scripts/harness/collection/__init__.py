"""The models in models/, for a user to open, run and copy."""
