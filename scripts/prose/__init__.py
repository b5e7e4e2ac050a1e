"""The style of the documentation: rules in the format of Vale (house/), and the check that applies them."""
