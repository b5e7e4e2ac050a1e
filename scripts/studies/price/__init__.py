"""What the contact costs: its times at the end of a run, beside those of FEBio's own interfaces."""
