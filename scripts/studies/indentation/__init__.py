"""Studies of problem 3.3: variants, extremes of concentration, convergence."""
