/// Loads of a state without a tangent, for explicit dynamics.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// Decides status and loads at a state for a residual without a tangent (see ContactPass::hold_loads). project() has to
/// be called before.
void hold_loads(ContactInterface& contact, const PerSide<SurfaceFields>& fields);

}  // namespace mixture_contact
