"""Random scenes and random parameters, from seeds, in search of crashes, NaN and violated balances."""
