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

/// Openings after another `ahead` [s], should they change as in the last step.
VectorXd expected_openings(const NodalLaws& laws, const NodalGaps& now, double ahead);

}  // namespace mixture_contact
