"""A model with FEBio's interface and converted, on finer and finer meshes: by how much they differ, which is nearer."""
