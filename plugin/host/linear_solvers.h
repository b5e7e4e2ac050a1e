/// Requirements of matrices with a contact on FEBio's linear solvers.
#pragma once

#include <string>

/// The kind of a matrix with contacts.
struct MatrixKind {
  bool symmetric = false;    ///< true if all contacts keep the matrix symmetric
  bool multipliers = false;  ///< true if the matrix contains multipliers, whose diagonal entries are zero
};

/// The reason why FEBio's linear solver of this type ("pardiso", "fgmres", ...) cannot solve such a matrix, with a
/// solver that can; empty if it can.
std::string linear_solver_complaint(const std::string& type, MatrixKind matrix);

/// True if a solver of this type can handle nodal loads as further unknowns (mixed_form.h), whose rows and columns have
/// entries of different size: solvers that scale the matrix and choose pivots by value.
bool takes_mixed_form(const std::string& type);
