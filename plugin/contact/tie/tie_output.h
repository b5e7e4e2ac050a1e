/// What a tie says about itself: balances, and values at the nodes of both surfaces.
#pragma once

#include "interface/output.h"
#include "tie/tie.h"

namespace mixture_contact {

/// Normal parts of gap and traction are those of a contact, tension being a negative pressure; tangential parts stand
/// where friction and slip do. Nodes that are not tied have zeros.
InterfaceOutput output(const Tie& tie, const PerSide<SurfaceFields>& fields);

}  // namespace mixture_contact
