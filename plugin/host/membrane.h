/// Membranes between the surfaces: what a model says of them, and what is wrong with that.
#pragma once

#include "contact/base/effects.h"
#include "contact/base/settings.h"
#include "contact_parameters.h"

#include <string>
#include <vector>

/// What is wrong with the parameters of a membrane, one sentence each; empty if nothing is. `solutes`: how many the
/// model has.
std::vector<std::string> membrane_complaints(const MembraneParameters& membrane, int solutes);

/// The counterpart for what a contact exchanges: reflected solutes need a film that the solvent crosses, too.
std::vector<std::string> membrane_complaints(const MembraneParameters& membrane,
                                             const mixture_contact::Effects& effects);

/// What a user should know of parameters of a membrane that have no effect, one sentence each.
std::vector<std::string> membrane_notices(const ContactParameters& parameters, const mixture_contact::Effects& effects);

/// The film as the core takes it.
mixture_contact::MembraneRule membrane_rule(const MembraneParameters& membrane);
