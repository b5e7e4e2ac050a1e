/// The guard against an increment that a line search has shortened.
///
/// FEBio's norms are those of the increment after its line search. That compares sums of energies and flows, which
/// may cancel by chance: it then shortens an increment that Newton's method got right, and most of the residual remains
/// though all norms are met. The next increment, which is the same, is to be taken as it is.
#pragma once

#include "helper.h"

#include <optional>

namespace newton {

class LineSearchGuard : public Helper {
 public:
  explicit LineSearchGuard(Solver& solver) : solver_(solver) {}

  /// The part left out in the last step, or in a failed attempt, counts no more.
  bool begin_step() override;
  void try_increment(const std::vector<double>& increment) override;
  /// Whether a solution that the solver is about to accept took a small part of its last increment for all of it; if so
  /// the next one is not searched. It does not count if the rest is rounding. Once in a step: where increments
  /// are rounding, so is the result of the search.
  bool rejects() override;
  void let_go() override { allow_search(); }

 private:
  void allow_search();

  Solver& solver_;
  double tried_ = 0;                 ///< length of the last trial's increment
  bool has_acted_ = false;           ///< in this step
  std::optional<double> tolerance_;  ///< the solver's, while the search is left out
};

}  // namespace newton
