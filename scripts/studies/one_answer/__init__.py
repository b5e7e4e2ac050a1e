"""Porous scenes with an edge of contact, solved in all ways that FEBio and the contact offer: one answer."""
