/// Comparison of nodal loads.
#pragma once

#include "conditions/nodal_laws.h"
#include "mortar/mortar_space.h"

namespace mixture_contact {

/// True if two loads differ by more than the fraction `part` of the largest load of their kind, and by more than
/// rounding.
bool differ(const MortarSpace& space, const NodalLaws& laws, const NodalLoads& one, const NodalLoads& other,
            double part, const FacingFields& fields);

}  // namespace mixture_contact
