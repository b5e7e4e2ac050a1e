/// The multipliers of a contact that are unknowns of the host's equation system.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// The order of the unknown multipliers (see UnknownMultipliers), which exist only with
/// Enforcement::lagrange_multipliers and one pass. The host has one equation for each, and sets them for every trial
/// state before residual() or tangent().
MultiplierLayout multiplier_layout(const ContactInterface& contact);
/// The values of the unknown multipliers.
VectorXd unknown_multipliers(const ContactInterface& contact);
/// Sets the unknown multipliers.
void set_unknown_multipliers(ContactInterface& contact, const VectorXd& mu);

}  // namespace mixture_contact
