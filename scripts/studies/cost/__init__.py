"""What accuracy costs: the parameters of a contact swept over the article's problems, and what the data say."""
