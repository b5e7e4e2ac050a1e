/// How far loads at nodes are from each other.
#pragma once

#include "conditions/nodal_laws.h"
#include "mortar/mortar_space.h"

namespace mixture_contact {

/// Whether loads differ by more than a part of the largest one of their kind, and by more than rounding.
bool differ(const MortarSpace& space, const NodalLaws& laws, const NodalLoads& one, const NodalLoads& other,
            double part, const FacingFields& fields);

}  // namespace mixture_contact
