#include "line_search_guard.h"

#include "norm.h"

#include <limits>
#include <utility>

namespace newton {
namespace {

/// A solution whose last increment the line search cut to less than this part is looked at once more.
constexpr double least_part = 0.5;

/// Whether no more is left of the residual than rounding: its square is lost in that of the first one. What a line
/// search compares then is rounding, too.
bool is_rounding(const Solver::ResidualSquares& residual) {
  return residual.now <= std::numeric_limits<double>::epsilon() * residual.first;
}

}  // namespace

bool LineSearchGuard::begin_step() {
  allow_search();
  has_acted_ = false;
  return false;
}

void LineSearchGuard::try_increment(const std::vector<double>& increment) {
  allow_search();
  tried_ = norm(increment);
}

bool LineSearchGuard::rejects() {
  double* const tolerance = solver_.line_search_tolerance();
  if (tolerance == nullptr || *tolerance == 0 || has_acted_) return false;
  if (tried_ >= least_part * norm(solver_.vectors().increment)) return false;
  if (is_rounding(solver_.residual_squares())) return false;
  has_acted_ = true;
  tolerance_ = std::exchange(*tolerance, 0.0);
  solver_.log(
      "line_search_guard: the line search shortened the last increment to less than half. FEBio does not accept this "
      "solution and applies the next increment without a line search.");
  return true;
}

void LineSearchGuard::allow_search() {
  double* const tolerance = solver_.line_search_tolerance();
  if (!tolerance_ || tolerance == nullptr) return;
  *tolerance = *tolerance_;
  tolerance_.reset();
}

}  // namespace newton
