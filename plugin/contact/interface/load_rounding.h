/// The rounding of positions in the loads of a contact.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// The sum over both surfaces' nodes of the squared forces that penalties make of a rounding of the positions [N^2]; 0
/// where multipliers are unknowns.
double load_rounding_square(const ContactInterface& contact, const PerSide<SurfaceFields>& fields);

}  // namespace mixture_contact
