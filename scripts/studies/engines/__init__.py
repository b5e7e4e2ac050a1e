"""The same models in febio4 and in the embedded engine, node by node."""
