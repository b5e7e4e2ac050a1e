/// The least residual that a solver can reach with a stiff contact.
///
/// A large penalty multiplies the rounding of positions. The residual is that rounding from the start of a step in
/// which nothing changes, and no part of it goes away: a test against its first value never ends.
#pragma once

#include "helper.h"

#include <functional>
#include <optional>
#include <utility>

namespace newton {

class ResidualFloor : public Helper {
 public:
  /// `rounding`: the square of the forces by rounding of positions under the present loads [N^2].
  ResidualFloor(Solver& solver, std::function<double()> rounding) : solver_(solver), rounding_(std::move(rounding)) {}

  /// The solver's own least residual is at least the rounding, until the step ends. One that a user gives stays.
  bool begin_step() override;
  void end_step() override { let_go(); }
  void rewind() override { let_go(); }
  void let_go() override;

 private:
  Solver& solver_;
  std::function<double()> rounding_;
  std::optional<double> given_;  ///< the solver's own, while it is raised [N^2]
};

}  // namespace newton
