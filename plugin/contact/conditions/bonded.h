/// The bonded condition: a traction that is linear in the gap vector, in tension and in compression.
#pragma once

#include "base/types.h"

namespace mixture_contact {

/// The traction of a bond, and its derivative with respect to the gap vector.
struct BondedTraction {
  Vector3d value;  ///< on the primary surface [MPa]
  double d_gap;    ///< factor of the identity in dt/dD [N/mm^3]
};

/// The traction t = lambda + eps D. A single penalty for all directions needs no local axes: the traction rotates with
/// the gap vector.
inline BondedTraction bonded_traction(const Vector3d& multiplier, double penalty, const Vector3d& gap) {
  return {multiplier + penalty * gap, penalty};
}

}  // namespace mixture_contact
