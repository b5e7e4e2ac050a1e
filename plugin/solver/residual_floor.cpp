#include "residual_floor.h"

#include <algorithm>

namespace newton {
namespace {

/// FEBio's default of the smallest residual [N^2]; any other value was set by the user.
constexpr double default_least = 1e-20;

}  // namespace

bool ResidualFloor::begin_step(Solver& solver) {
  let_go(solver);
  double* const least = solver.residual_squares().least;
  if (least == nullptr || *least != default_least) return false;
  given_ = *least;
  *least = std::max(*least, rounding_());
  return *least > *given_;
}

void ResidualFloor::let_go(Solver& solver) {
  double* const least = solver.residual_squares().least;
  if (given_ && least != nullptr) *least = *given_;
  given_.reset();
}

}  // namespace newton
