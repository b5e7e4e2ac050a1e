/// What FEBio's line search leaves of an increment.
///
/// FEBio's norms are those of what its line search left of an increment. It compares sums of energies and flows, which
/// may cancel by chance: it then cuts an increment that Newton's method got right, and most of the residual remains
/// though all norms are met. The next increment, which is the same, is to be taken as it is.
#pragma once

#include <optional>
#include <vector>

class FENewtonSolver;

class LineSearch {
 public:
  /// What was left out in the last step, or in a failed attempt, counts no more.
  void begin_step(FENewtonSolver* solver);

  /// A trial of the solver's last increment, or of a part of it.
  void tried(FENewtonSolver* solver, const std::vector<double>& increment);

  /// Whether a solution that FEBio is about to accept took a small part of its last increment for all of it; if so the
  /// next one is not searched. Once in a step: where increments are rounding, so is what the search finds.
  bool cut_short(FENewtonSolver* solver);

 private:
  void allow(FENewtonSolver* solver);

  double tried_ = 0;                 ///< length of the last trial's increment
  bool has_been_left_out_ = false;   ///< in this step
  std::optional<double> tolerance_;  ///< the solver's, while the search is left out
};
