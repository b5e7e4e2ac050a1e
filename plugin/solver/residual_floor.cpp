#include "residual_floor.h"

#include <algorithm>

namespace newton {

void ResidualFloor::begin_step() {
  let_go();
  double* const least = solver_.residual_squares().least;
  if (least == nullptr) return;
  given_ = *least;
  *least = std::max(*least, rounding_());
}

void ResidualFloor::let_go() {
  double* const least = solver_.residual_squares().least;
  if (given_ && least != nullptr) *least = *given_;
  given_.reset();
}

}  // namespace newton
