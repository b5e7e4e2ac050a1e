/// Linearising averages, and what else is made of the same points.
#pragma once

#include "mortar/linearisation.h"
#include "mortar/loaded_points.h"

#include <functional>

namespace mixture_contact {

/// Takes the points of a pair of facets, given by its index, that carries load.
using UseVaryingPoints = std::function<void(Index pair, const std::vector<VaryingPoint>& points)>;

/// Linearises the averages of the nodes in contact, as linearise() does, and has the points used otherwise, too: once
/// for each pair that carries load, on several threads. The points carry the loads `carried`, in a time increment of 1.
IndexedVector<NodeLinearisation> linearise(const MortarSpace& space, const NodalLoads& loads,
                                           const FacingFields& fields, const NodalLoads& carried,
                                           const UseVaryingPoints& use);

}  // namespace mixture_contact
