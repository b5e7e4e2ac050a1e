/// Linearisation of both parts of the tangent at the same time: the part of the nodal loads, and the geometric part.
#pragma once

#include "enforcement/past_linearisation.h"

namespace mixture_contact {

/// The loads in the geometric part of the tangent at a linearisation point.
NodalLoads geometric_loads(const LinearisationPoint& point);

/// Linearises at a point with the averages and loads of the present integration points. Sets LinearisationPoint::nodes,
/// and returns the geometric part of the tangent.
///
/// `past`: a linearisation that is reused around nodes where no quantity has changed by more than the fraction `same`
/// (see changed_nodes()). `memory`: parts of pairs that are no longer needed, whose memory is reused.
GeometricPart linearise_both_parts(LinearisationPoint& point, const MortarSpace& space, const FacingFields& fields,
                                   std::optional<PastLinearisation> past = std::nullopt, double same = 0,
                                   GeometricParts memory = {});

}  // namespace mixture_contact
