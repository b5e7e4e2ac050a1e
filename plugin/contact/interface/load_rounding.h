/// The effect of the rounding of positions on the loads of a contact.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// The sum over the nodes of both surfaces of the squared forces that the penalties cause for a rounding error of the
/// positions [N^2]; 0 if multipliers are unknowns.
double load_rounding_square(const ContactInterface& contact, const PerSide<SurfaceFields>& fields);

}  // namespace mixture_contact
