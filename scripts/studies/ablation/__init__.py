"""What each device of the solver does for iterations, retries and the matrix: runs with all, and with each left out."""
