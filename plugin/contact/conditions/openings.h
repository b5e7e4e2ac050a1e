/// How far nodes are from a change of status, and how that goes on.
#pragma once

#include "conditions/nodal_laws.h"

namespace mixture_contact {

/// Per node the gap where it is open, and what its traction makes of the adjoining elements, t/k < 0, where it is in
/// contact [mm]; infinite where it faces nothing. Free of the penalty, so that a penalty that changes looks like no
/// motion.
VectorXd openings(const NodalLaws& laws, const NodalGaps& now);

/// Takes openings over as those that the first step begins with, where none are known.
void start_openings(NodalLaws& laws, const NodalGaps& now);

/// Takes openings over as those that a step of `dt` ended with [s], and judges by them what the step before foretold:
/// where it would have had nodes change status, whether that would have left less than half as many of them wrong.
/// Where loads turn, surfaces roll or contact has just been found, the last step does not tell what the next one does.
void take_openings(NodalLaws& laws, const NodalGaps& now, double dt);

/// Openings after another `ahead` [s], should they change as in the last step; the present ones where that is unknown.
///
/// Once any node is in contact, the gap o of an open one is extrapolated by way of o^(2/3). Beside the edge of contact
/// smooth elastic surfaces part with the power 3/2 of the distance from it, as expanding the displacement outside a
/// Hertz contact shows (Johnson 1985, Contact Mechanics, equation 3.42a), so that o^(2/3) changes evenly where the edge
/// moves evenly. The gap itself closes ever more slowly there. Far from any contact it does not, and nodes are expected
/// to close too late.
VectorXd expected_openings(const NodalLaws& laws, const NodalGaps& now, double ahead);

}  // namespace mixture_contact
