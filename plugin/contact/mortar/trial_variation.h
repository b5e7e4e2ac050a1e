/// How trial frictions vary.
#pragma once

#include "conditions/nodal_laws.h"
#include "mortar/linearisation.h"

namespace mixture_contact {

/// dtau_a/du of a node, columns in the order of gap_variation. The part that turns with the surface is the geometric
/// vector of an iteration if it has one.
Matrix3Xd trial_variation(const NodalLaws& laws, Index node, const NodeLinearisation& linear,
                          const NodalFriction& friction);

/// Sets it for all nodes in contact.
void vary_trials(const NodalLaws& laws, const NodalLoads& loads, IndexedVector<NodeLinearisation>& nodes);

}  // namespace mixture_contact
