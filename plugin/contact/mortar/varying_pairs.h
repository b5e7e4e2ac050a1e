/// Linearisation of averages and of further quantities of the same pairs.
#pragma once

#include "mortar/linearisation.h"
#include "mortar/loaded_points.h"

#include <functional>

namespace mixture_contact {

/// Takes a pair of facets that carries load, given by its index.
using UseVaryingPair = std::function<void(Index pair, const VaryingPair& varying)>;

/// Linearises the averages of the nodes in contact, as linearise() does, and has the pairs used otherwise, too: once
/// each that carries load, on several threads. They carry the loads `carried`, in a time increment of 1.
IndexedVector<NodeLinearisation> linearise(const MortarSpace& space, const NodalLoads& loads,
                                           const FacingFields& fields, const NodalLoads& carried,
                                           const UseVaryingPair& use);

}  // namespace mixture_contact
