"""What the predictor saves or costs: every model and every hard case with it and without it."""
