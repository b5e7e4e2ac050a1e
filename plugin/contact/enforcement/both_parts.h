/// Linearising both parts of the tangent at once: that of the loads at nodes, and that of the geometry under them.
#pragma once

#include "enforcement/past_linearisation.h"

namespace mixture_contact {

/// The loads of the geometric part of the tangent.
NodalLoads geometric_loads(const LinearisationPoint& point);

/// Linearises at a point, whose averages and loads are those of the present points: sets its nodes, and returns the
/// geometric part. A past linearisation is taken over around nodes where nothing has changed by more than a part `same`
/// (see changed_nodes()). `memory`: parts of pairs that are held no more, whose memory serves those to come.
GeometricPart linearise_both_parts(LinearisationPoint& point, const MortarSpace& space, const FacingFields& fields,
                                   std::optional<PastLinearisation> past = std::nullopt, double same = 0,
                                   GeometricParts memory = {});

}  // namespace mixture_contact
