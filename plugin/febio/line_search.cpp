#include "line_search.h"

#include <FECore/FELineSearch.h>
#include <FECore/FENewtonSolver.h>

#include <utility>

namespace {

/// A solution whose last increment the line search cut to less than this part is looked at once more.
constexpr double least_part = 0.5;

}  // namespace

void LineSearch::begin_step(FENewtonSolver* solver) {
  allow(solver);
  has_been_left_out_ = false;
}

void LineSearch::tried(FENewtonSolver* solver, const std::vector<double>& increment) {
  allow(solver);
  tried_ = l2_norm(increment);
}

bool LineSearch::cut_short(FENewtonSolver* solver) {
  if (solver == nullptr) return false;
  double& tolerance = solver->GetLineSearch()->m_LStol;
  const bool is_whole = tried_ >= least_part * l2_norm(solver->m_ui);
  if (is_whole || has_been_left_out_ || tolerance == 0) return false;
  has_been_left_out_ = true;
  tolerance_ = std::exchange(tolerance, 0.0);
  return true;
}

void LineSearch::allow(FENewtonSolver* solver) {
  if (!tolerance_ || solver == nullptr) return;
  solver->GetLineSearch()->m_LStol = *tolerance_;
  tolerance_.reset();
}
