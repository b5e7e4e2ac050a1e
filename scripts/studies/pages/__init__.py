"""Pages of the documentation that are made from code or numbers, and the gallery."""
