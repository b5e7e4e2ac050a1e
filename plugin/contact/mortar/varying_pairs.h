/// Linearisation of nodal averages that also passes the variations of the pairs to a function.
#pragma once

#include "mortar/linearisation.h"
#include "mortar/loaded_points.h"

#include <functional>

namespace mixture_contact {

/// Receives a pair that carries load: its index and its variations.
using UseVaryingPair = std::function<void(Index pair, const VaryingPair& varying)>;

/// Linearises the averages of the nodes in contact, as linearise() does, and calls `use` once for each pair that
/// carries load, on several threads. The pairs passed to `use` have the loads `carried` and a time increment of 1.
IndexedVector<NodeLinearisation> linearise(const MortarSpace& space, const NodalLoads& loads,
                                           const FacingFields& fields, const NodalLoads& carried,
                                           const UseVaryingPair& use);

}  // namespace mixture_contact
