/// Augmented Lagrangian updates: lambda takes the load of a converged solution; slow fields get a larger penalty.
#pragma once

#include "conditions/nodal_laws.h"
#include "enforcement/gap_measures.h"

namespace mixture_contact {

/// Gaps and jumps of the nodes in contact, given the loads at a state.
///
/// The relative measure is free of units: rms(eps0 gap)/rms(load), with eps0 the stiffness or conductance of the
/// adjoining elements. The jump is compared with the field's own size instead if no load flows, so 0/0 never
/// arises; and a jump within NodalLaws::field_rounding() is none, so that a pressure that nothing drives is
/// converged.
GapReport measure_gaps(const NodalLaws& laws, const NodalLoads& loads, const FacingFields& fields);

/// Tenfold penalties for the fields that miss the relative tolerance, up to the automatic penalties: plain
/// Uzawa converges by a factor of k/(k + eps) an update, k the bodies' own conductance, and so crawls where eps is
/// small. Returns whether any has grown.
bool grow_penalties(NodalLaws& laws, const GapReport& report, const Tolerances& tolerances);

}  // namespace mixture_contact
