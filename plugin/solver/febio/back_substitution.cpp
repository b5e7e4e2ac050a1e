#include "back_substitution.h"

#include "indexing/entries.h"

#include <FECore/LinearSolver.h>

#include <cstring>
#include <utility>

#if __has_include(<NumCore/PardisoSolver.h>)
#include <NumCore/PardisoSolver.h>
#define MIXCONTACT_HAS_PARDISO
#endif

namespace newton {
namespace {

#ifdef MIXCONTACT_HAS_PARDISO
/// FEBio's `pardiso` with access to its number of right-hand sides, for which it has no function.
class Pardiso : public PardisoSolver {
 public:
  Pardiso() = delete;
  /// The number of a linear solver; null if it is no `pardiso`. On some systems, FEBio does not export the class to a
  /// dynamic_cast.
  static int* right_hand_sides(LinearSolver& solver) {
    const bool is_pardiso = std::strcmp(solver.GetTypeStr(), "pardiso") == 0;
    return is_pardiso ? &(static_cast<PardisoSolver&>(solver).*(&Pardiso::m_nrhs)) : nullptr;
  }
};

int* right_hand_sides(LinearSolver& solver) { return Pardiso::right_hand_sides(solver); }
#else
/// The SDK lacks the class of `pardiso`.
int* right_hand_sides(LinearSolver& /*solver*/) { return nullptr; }
#endif

/// Solves for the right-hand sides one after the other. Returns false if the linear solver fails.
bool solve_each(LinearSolver& solver, Eigen::MatrixXd& rights, Eigen::MatrixXd& solutions) {
  for (Eigen::Index n = 0; n < rights.cols(); ++n) {
    if (!solver.BackSolve(solutions.col(n).data(), rights.col(n).data())) return false;
  }
  return true;
}

}  // namespace

Eigen::MatrixXd back_substitute(LinearSolver& solver, Eigen::MatrixXd rights) {
  Eigen::MatrixXd solutions = Eigen::MatrixXd::Zero(rights.rows(), rights.cols());
  int* const count = right_hand_sides(solver);
  if (count == nullptr) return solve_each(solver, rights, solutions) ? solutions : Eigen::MatrixXd();
  const int before = std::exchange(*count, indexing::as_int(rights.cols()));
  const bool is_solved = solver.BackSolve(solutions.data(), rights.data());
  *count = before;
  return is_solved ? solutions : Eigen::MatrixXd();
}

}  // namespace newton
