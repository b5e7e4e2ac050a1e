/// Variation of the trial friction tau_a with respect to the nodal positions.
#pragma once

#include "conditions/nodal_laws.h"
#include "mortar/linearisation.h"

namespace mixture_contact {

/// The derivative dtau_a/du of a node, columns in the order of gap_variation. If the iteration has a geometric friction
/// traction, this vector is used for the part that rotates with the surface.
Matrix3Xd trial_variation(const NodalLaws& laws, Index node, const NodeLinearisation& linear,
                          const NodalFriction& friction);

/// Sets SlipLinearisation::trial_variation for all nodes in contact.
void vary_trials(const NodalLaws& laws, const NodalLoads& loads, IndexedVector<NodeLinearisation>& nodes);

}  // namespace mixture_contact
