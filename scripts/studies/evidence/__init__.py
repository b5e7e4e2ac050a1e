"""All comparisons and all other evidence, measured anew in one go."""
