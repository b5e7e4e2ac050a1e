#include "line_search_guard.h"

#include "norm.h"

#include <limits>
#include <utility>

namespace newton {
namespace {

/// If the line search has shortened the last increment of a solution to less than this fraction, the solution is
/// checked by another iteration.
constexpr double least_part = 0.5;

/// True if the residual has decreased to rounding: its square is negligible compared with that of the first residual. A
/// line search would then compare rounding errors.
bool is_rounding(const Solver::ResidualSquares& residual) {
  return residual.now <= std::numeric_limits<double>::epsilon() * residual.first;
}

}  // namespace

bool LineSearchGuard::begin_step(Solver& solver) {
  allow_search(solver);
  has_acted_ = false;
  return false;
}

void LineSearchGuard::try_increment(Solver& solver, const std::vector<double>& increment) {
  allow_search(solver);
  tried_ = norm(increment);
}

bool LineSearchGuard::rejects(Solver& solver) {
  double* const tolerance = solver.line_search().tolerance;
  if (tolerance == nullptr || *tolerance == 0 || has_acted_) return false;
  if (tried_ >= least_part * norm(solver.vectors().increment)) return false;
  if (is_rounding(solver.residual_squares())) return false;
  has_acted_ = true;
  tolerance_ = std::exchange(*tolerance, 0.0);
  solver.log(
      "line_search_guard: the line search shortened the last increment to less than half. FEBio does not accept this "
      "solution and applies the next increment without a line search.");
  return true;
}

void LineSearchGuard::allow_search(Solver& solver) {
  double* const tolerance = solver.line_search().tolerance;
  if (!tolerance_ || tolerance == nullptr) return;
  *tolerance = *tolerance_;
  tolerance_.reset();
}

}  // namespace newton
