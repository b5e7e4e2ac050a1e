"""Problem 3.3, the article's semi-cylinder on a slab: histories, measures and pictures."""
