/// Augmented Lagrangian updates: the multipliers become the loads of a converged solution, and fields that converge
/// slowly get a larger penalty.
#pragma once

#include "conditions/nodal_laws.h"
#include "enforcement/gap_measures.h"

namespace mixture_contact {

/// The gaps and jumps of the nodes in contact, with the loads at a state.
///
/// The relative measure has no unit: rms(eps0 gap)/rms(load), where eps0 is the stiffness or conductance of the
/// adjoining elements. If no load acts, the jump is compared with the size of the field instead, such that 0/0 cannot
/// occur. A jump within NodalLaws::field_rounding() counts as zero; a pressure that nothing drives has therefore
/// converged.
GapReport measure_gaps(const NodalLaws& laws, const NodalLoads& loads, const FacingFields& fields);

/// Multiplies the penalties of the fields that miss the relative tolerance by ten, up to the automatic penalties.
/// Returns true if a penalty has grown.
///
/// Each update of Uzawa's method reduces a jump by the factor k/(k + eps), with the conductance k of the bodies, and
/// converges slowly if eps is small.
bool grow_penalties(NodalLaws& laws, const GapReport& report, const Tolerances& tolerances);

}  // namespace mixture_contact
