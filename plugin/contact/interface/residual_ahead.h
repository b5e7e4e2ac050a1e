/// What nodes add to a residual that begin a step in contact though they are open.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// The part of ContactInterface::residual() that is the pull of nodes which begin a step in contact though they are
/// open (see ActiveSet::expected()): it is not of the state that the step begins at, and a thousand times what its
/// loads are. Nothing where multipliers are unknowns, which begin at zero.
void residual_ahead(const ContactInterface& contact, const PerSide<SurfaceFields>& fields, double dt,
                    const ContactInterface::AddResidual& add);

}  // namespace mixture_contact
