/// The smallest residual that a solver can reach with stiff contact.
///
/// A large penalty multiplies the rounding of positions. In a step without changes, the residual consists of this
/// rounding from the start and cannot decrease, such that a test relative to its first value would never pass.
#pragma once

#include "helper.h"

#include <functional>
#include <optional>
#include <utility>

namespace newton {

/// The helper that raises the solver's smallest residual.
class ResidualFloor : public Helper {
 public:
  /// `rounding`: returns the squared norm of the forces that the rounding of positions causes at the present loads
  /// [N^2].
  explicit ResidualFloor(std::function<double()> rounding) : rounding_(std::move(rounding)) {}

  /// Raises the solver's smallest residual to the rounding until the end of the step. A larger value set by the user is
  /// kept.
  bool begin_step(Solver& solver) override;
  void end_step(Solver& solver) override { let_go(solver); }
  void rewind(Solver& solver) override { let_go(solver); }
  void let_go(Solver& solver) override;

 private:
  std::function<double()> rounding_;
  std::optional<double> given_;  ///< the solver's own smallest residual, while it is raised [N^2]
};

}  // namespace newton
