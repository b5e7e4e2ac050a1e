"""A page about a run: contact pressure on the deformed surfaces, force, area, fluid share and balances over time.

The page is made from the files that FEBio wrote, for any model with a sliding contact of FEBio or of this plugin.
"""
