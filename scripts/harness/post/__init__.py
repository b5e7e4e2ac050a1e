"""Numbers and pictures from what a run wrote: differences, balances, sections."""
