/// The unknown multipliers of a contact, for which a host solves.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// Unknown multipliers (see UnknownMultipliers): present with Enforcement::lagrange_multipliers alone, and in one pass
/// only. The host gives each an equation, and sets them with every trial state before residual() or tangent().
MultiplierLayout multiplier_layout(const ContactInterface& contact);
VectorXd unknown_multipliers(const ContactInterface& contact);
void set_unknown_multipliers(ContactInterface& contact, const VectorXd& mu);

}  // namespace mixture_contact
