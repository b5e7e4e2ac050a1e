/// FEBio's linear solvers: those that can solve the matrix of a contact, and those that take loads as further unknowns.
#pragma once

#include <string>

/// What a matrix with a contact asks of a linear solver.
struct MatrixKind {
  bool symmetric = false;    ///< whether all contacts keep it symmetric
  bool multipliers = false;  ///< whether it holds multipliers, whose diagonal is zero
};

/// What is wrong with solving such a matrix by FEBio's solver of this type ("pardiso", "fgmres", ...), and what to take
/// instead; empty where nothing is known against it.
std::string linear_solver_complaint(const std::string& type, MatrixKind matrix);

/// Whether a solver of this type may be given loads at nodes as further unknowns (mixed_form.h), whose rows and columns
/// are of other sizes than the rest: those that scale the matrix and choose their pivots by its values.
bool takes_mixed_form(const std::string& type);
