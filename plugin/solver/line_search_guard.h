/// The guard against increments that a line search has shortened.
///
/// FEBio's convergence norms use the increment after the line search. The search compares sums of energies and flows,
/// which may cancel by chance. It then shortens a correct increment, and most of the residual remains although all
/// norms are met. The guard repeats the iteration without the line search.
#pragma once

#include "helper.h"

#include <optional>

namespace newton {

/// The helper that repeats an iteration whose increment the line search has shortened.
class LineSearchGuard : public Helper {
 public:
  /// Discards the data of the last step or of a failed attempt.
  bool begin_step(Solver& solver) override;
  void try_increment(Solver& solver, const std::vector<double>& increment) override;
  /// True if the line search shortened the last increment to a small fraction before the solver accepts a solution,
  /// unless the residual is rounding. The next increment then has no line search. It acts once in a step, because a
  /// line search has no meaning for increments of the size of rounding.
  bool rejects(Solver& solver) override;
  void let_go(Solver& solver) override { allow_search(solver); }

 private:
  /// Restores the solver's line search.
  void allow_search(Solver& solver);

  double tried_ = 0;                 ///< norm of the increment in the last trial
  bool has_acted_ = false;           ///< true if the guard has acted in this step
  std::optional<double> tolerance_;  ///< the solver's tolerance of the line search, while the search is disabled
};

}  // namespace newton
