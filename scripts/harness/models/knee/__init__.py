"""A knee from analytic shapes: two condyles, a tibial plateau, cartilage on rigid bone, menisci on springs."""
