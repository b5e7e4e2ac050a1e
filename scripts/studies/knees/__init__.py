"""The knee with the plugin's contact and with FEBio's, by defaults and with the same limits."""
