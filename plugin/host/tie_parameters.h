/// The parameters of <contact type="tied-mixture"> in a model file: a part of those of sliding contact, under the same
/// names and with the same meaning.
#pragma once

#include "contact/tie/tied_node.h"
#include "contact_parameters.h"
#include "exchange.h"

/// Whether a tie has this parameter of sliding contact.
bool is_parameter_of_ties(const ParameterTag& tag);

/// Calls take(tag, value) for each parameter of a tie.
template <class Take>
void for_each_tie_parameter(ContactParameters& parameters, const Take& take) {
  for_each_parameter(parameters, [&](const ParameterTag& tag, auto& value) {
    if (is_parameter_of_ties(tag)) take(tag, value);
  });
}

/// The core's settings of a tie. `time_step`: in which elements store solvent [s]; 0: they do not.
mixture_contact::Settings tie_settings(const ContactParameters& parameters, SolverKind solver, double time_step);

/// What a tie exchanges of the fields of its surfaces (see decide_exchange()); a penalty of 0 leaves out its own effect
/// alone.
Exchange tie_exchange(const ContactParameters& parameters, std::vector<FieldAtContact> fields);

/// Says how many of the primary nodes are tied, and what keeps the others free.
std::string tied_nodes_line(mixture_contact::Index tied, const mixture_contact::UntiedNodes& untied);
