"""What the plugin is held to: checks with their tolerances, results as data, figures 3.2 and 3.3."""
