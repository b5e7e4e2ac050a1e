/// The parameters of friction in a model, their faults, and the friction that they request. No other file of a host
/// asks whether a model has friction.
#pragma once

#include "exchange.h"

/// Adds the faults of the parameters of friction to a list, one sentence each.
void complain_of_friction(const ContactParameters& parameters, std::vector<std::string>& list);

/// Adds notices for the user about parameters of friction without effect to a list, one sentence each.
void note_friction(const ContactParameters& parameters, std::vector<std::string>& list);

/// The load of the friction that the parameters request, also if only a load curve gives it a coefficient. `has_fluid`:
/// true if a body has fluid whose pressure is an unknown, and may bear a part of the load.
mixture_contact::FrictionKind requested_friction(const ContactParameters& parameters, bool has_fluid);

/// Decides on friction of the kind that the model requests. `named`: true if <effects> names it. `wanted`: true if
/// <effects> includes it. `present` and `absent`: texts for the summary.
void decide_friction(mixture_contact::FrictionKind requested, bool named, bool wanted, Exchange& result,
                     std::vector<std::string>& present, std::string& absent);

/// True if ambient values have an effect: on open nodes, or through the load that the fluid bears.
bool reads_ambient_values(const ContactParameters& parameters);

/// The settings of friction for the contact core. `factor`: the traction penalty divided by the stiffness.
mixture_contact::FrictionRule friction_rule(const ContactParameters& parameters, double factor);
