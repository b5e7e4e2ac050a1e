/// Loads of a state without a tangent, as in explicit dynamics.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// Decides status and loads at a state for a residual without tangent, after project() (see ContactPass::hold_loads).
void hold_loads(ContactInterface& contact, const PerSide<SurfaceFields>& fields);

}  // namespace mixture_contact
