/// Linearising both parts of the tangent at once: that of the loads at nodes, and that of the geometry under them.
#pragma once

#include "enforcement/past_linearisation.h"

namespace mixture_contact {

/// The loads of the geometric part of the tangent.
NodalLoads geometric_loads(const LinearisationPoint& point);

/// Linearises at a point with the averages and loads of the present integration points. Sets the nodes of the point,
/// and returns the geometric part. Reuses the past linearisation around nodes where no quantity has changed by more
/// than a part `same` (see changed_nodes()). `memory`: dropped parts of pairs, whose memory the new parts use again.
GeometricPart linearise_both_parts(LinearisationPoint& point, const MortarSpace& space, const FacingFields& fields,
                                   std::optional<PastLinearisation> past = std::nullopt, double same = 0,
                                   GeometricParts memory = {});

}  // namespace mixture_contact
