/// The parameters of membranes in a model, and their faults.
#pragma once

#include "contact/base/effects.h"
#include "contact/base/settings.h"
#include "contact_parameters.h"

#include <string>
#include <vector>

/// The faults of the parameters of a membrane, one sentence each; empty if there are none. `solutes`: number of solutes
/// in the model.
std::vector<std::string> membrane_complaints(const MembraneParameters& membrane, int solutes);

/// The faults of a membrane for the exchanged effects, one sentence each: reflected solutes require a membrane that the
/// solvent can cross.
std::vector<std::string> membrane_complaints(const MembraneParameters& membrane,
                                             const mixture_contact::Effects& effects);

/// Notices for the user about parameters of a membrane without effect, one sentence each.
std::vector<std::string> membrane_notices(const ContactParameters& parameters, const mixture_contact::Effects& effects);

/// The settings of the membrane for the contact core.
mixture_contact::MembraneRule membrane_rule(const MembraneParameters& membrane);
