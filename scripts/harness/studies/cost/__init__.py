"""What accuracy costs: the knobs of a contact swept over the article's problems, and what the data say."""
