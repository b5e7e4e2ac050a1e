"""One page with a row for each run of several studies."""
