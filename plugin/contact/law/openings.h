/// How far nodes are from a change of status, and how fast that changes.
#pragma once

#include "law/nodal_laws.h"

namespace mixture_contact {

/// Per node the gap where it is open, and what its traction makes of the adjoining elements, t/k < 0, where it is in
/// contact [mm]; infinite where it faces nothing. Free of the penalty, so that a penalty that changes looks like no
/// motion.
VectorXd openings(const NodalLaws& laws, const NodalGaps& now);

/// Takes openings over as those that the first step begins with, where none are known.
void start_openings(NodalLaws& laws, const NodalGaps& now);

/// Takes openings over as those that a step of `dt` ended with [s].
void take_openings(NodalLaws& laws, const NodalGaps& now, double dt);

/// Forgets how they changed in the last step: what is to come has nothing to do with it.
void forget_motion(NodalLaws& laws);

/// Openings after another `ahead` [s], should what is in contact spread, or bodies that are not come nearer, as fast as
/// in the last step; the present ones where that is unknown.
///
/// Where nodes are in contact, a gap o beside it is taken for o^(2/3), which changes evenly where the edge of contact
/// does: beside that edge smooth surfaces part with the power 3/2 of the distance (Johnson 1985, Contact Mechanics,
/// section 5.1). A gap itself closes ever more slowly there, since the surface is pressed away from it.
VectorXd expected_openings(const NodalLaws& laws, const NodalGaps& now, double ahead);

}  // namespace mixture_contact
