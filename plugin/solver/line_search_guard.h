/// The guard against an increment that a line search has shortened.
///
/// FEBio's norms are those of the increment after its line search. The search compares sums of energies and flows,
/// which may cancel by chance. It then shortens a correct increment, and most of the residual remains although all
/// norms are met. The guard takes the next increment as a whole.
#pragma once

#include "helper.h"

#include <optional>

namespace newton {

class LineSearchGuard : public Helper {
 public:
  explicit LineSearchGuard(Solver& solver) : solver_(solver) {}

  /// Drops the record of the last step or of a failed attempt.
  bool begin_step() override;
  void try_increment(const std::vector<double>& increment) override;
  /// Whether the line search took a small part of the last increment before the solver accepts a solution; the next
  /// increment then has no search. A remainder of rounding does not count. Acts once in a step, because the search has
  /// no meaning for increments of rounding.
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
