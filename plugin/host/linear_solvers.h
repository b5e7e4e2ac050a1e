/// FEBio's linear solvers: those that can solve the matrix of a contact, and those that take loads as further unknowns.
#pragma once

#include <string>

/// The requirements of a matrix with a contact on a linear solver.
struct MatrixKind {
  bool symmetric = false;    ///< whether all contacts keep it symmetric
  bool multipliers = false;  ///< whether it holds multipliers, whose diagonal is zero
};

/// The reason why FEBio's solver of this type cannot solve such a matrix ("pardiso", "fgmres", ...), and another one to
/// take; empty if there is none.
std::string linear_solver_complaint(const std::string& type, MatrixKind matrix);

/// Whether a solver of this type may be given loads at nodes as further unknowns (mixed_form.h), whose rows and columns
/// are of other sizes than the rest: those that scale the matrix and choose their pivots by its values.
bool takes_mixed_form(const std::string& type);
