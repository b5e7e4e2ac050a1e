/// Membranes between the surfaces: their parameters in a model, and faults of these.
#pragma once

#include "contact/base/effects.h"
#include "contact/base/settings.h"
#include "contact_parameters.h"

#include <string>
#include <vector>

/// The faults of the parameters of a membrane, one sentence each; empty if there are none. `solutes`: how many the
/// model has.
std::vector<std::string> membrane_complaints(const MembraneParameters& membrane, int solutes);

/// The faults of a membrane in view of the exchange: reflected solutes need a film that the solvent crosses.
std::vector<std::string> membrane_complaints(const MembraneParameters& membrane,
                                             const mixture_contact::Effects& effects);

/// Notices for a user about parameters of a membrane that have no effect, one sentence each.
std::vector<std::string> membrane_notices(const ContactParameters& parameters, const mixture_contact::Effects& effects);

/// The film as the core takes it.
mixture_contact::MembraneRule membrane_rule(const MembraneParameters& membrane);
