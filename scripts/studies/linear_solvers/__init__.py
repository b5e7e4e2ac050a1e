"""Which of FEBio's linear solvers solve the matrix of a contact, by enforcement."""
