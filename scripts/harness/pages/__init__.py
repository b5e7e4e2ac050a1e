"""Pages of the documentation that are made from code or numbers, the collection in models/, and the gallery."""
