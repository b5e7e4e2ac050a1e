/// Bonded surfaces: a traction that follows the gap vector both ways, in tension as in compression.
#pragma once

#include "base/types.h"

namespace mixture_contact {

/// The traction of a bond, and its derivative with the gap vector.
struct BondedTraction {
  Vector3d value;  ///< on the primary surface [MPa]
  double d_gap;    ///< times the identity [N/mm^3]
};

/// t = lambda + eps D. One penalty for all directions needs no frame: the traction turns with the gap vector.
inline BondedTraction bonded_traction(const Vector3d& multiplier, double penalty, const Vector3d& gap) {
  return {multiplier + penalty * gap, penalty};
}

}  // namespace mixture_contact
