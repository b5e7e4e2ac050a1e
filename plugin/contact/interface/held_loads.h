/// Loads of a state without a tangent, as in explicit dynamics.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// Decides at a state, after project(), what a residual needs and no tangent (see ContactPass::hold_loads).
void hold_loads(ContactInterface& contact, const PerSide<SurfaceFields>& fields);

}  // namespace mixture_contact
