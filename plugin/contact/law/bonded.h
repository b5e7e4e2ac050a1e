/// Bonded surfaces: a load that follows a gap or a jump both ways, in tension as in compression.
#pragma once

namespace mixture_contact {

/// The load of a bond, and its derivative with the gap. `Value`: a vector for a traction, a number for a flux.
template <class Value>
struct BondedLoad {
  Value value;
  double d_gap;  ///< times the identity
};

/// t = lambda + eps D, or w = lambda + eps [p]. One penalty for all directions needs no frame: the load turns with the
/// gap vector.
template <class Value>
BondedLoad<Value> bonded(const Value& multiplier, double penalty, const Value& gap) {
  return {multiplier + penalty * gap, penalty};
}

}  // namespace mixture_contact
