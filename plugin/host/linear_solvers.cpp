#include "linear_solvers.h"

#include <set>

namespace {

/// Solvers that use one triangle of the matrix only.
const std::set<std::string>& symmetric_only() {
  static const std::set<std::string> types{"skyline", "cg", "hypre_pcg_amg"};
  return types;
}

/// Krylov methods: with or without incomplete factorisation they divide by the diagonal, or do not converge.
const std::set<std::string>& iterative() {
  static const std::set<std::string> types{"fgmres", "bicgstab", "hypre_gmres", "boomeramg"};
  return types;
}

}  // namespace

std::string linear_solver_complaint(const std::string& type, MatrixKind matrix) {
  const std::string subject = "the linear solver '" + type + "' ";
  const std::string instead = " Use pardiso, mkl_dss or superlu_mt.";
  if (symmetric_only().count(type) > 0 && !matrix.symmetric) {
    return subject + "solves symmetric matrices only, and the matrix of this contact is not symmetric." + instead;
  }
  if (symmetric_only().count(type) > 0 && matrix.multipliers) {
    return subject +
           "solves positive definite matrices only, and <laugon>LAGMULT</laugon> puts zeros on the diagonal." + instead;
  }
  if (iterative().count(type) > 0 && matrix.multipliers) {
    return subject +
           "is iterative, and <laugon>LAGMULT</laugon> puts zeros on the diagonal of the matrix. Incomplete "
           "factorisations divide by the diagonal, and the solver may find no solution." +
           instead;
  }
  return "";
}

bool takes_mixed_form(const std::string& type) { return type == "pardiso"; }
