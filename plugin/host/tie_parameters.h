/// The parameters of <contact type="tied-mixture"> in a model file: a part of those of sliding contact, under the same
/// names and with the same meaning.
#pragma once

#include "contact/tie/breaking.h"
#include "contact/tie/tied_node.h"
#include "contact_parameters.h"
#include "exchange.h"

#include <string>
#include <vector>

/// The values at which a tie breaks. It lasts for ever without a strength.
struct BreakingParameters {
  Given<double> max_traction;           ///< sigma_c [MPa]
  Given<double> max_shear;              ///< tau_c [MPa]; by default sigma_c
  Given<double> fracture_energy;        ///< G_n [N/mm]
  Given<double> fracture_energy_shear;  ///< G_s [N/mm]; by default G_n
  Given<double> mixing{2};              ///< eta [-]
  Given<double> viscosity;              ///< tau, by which damage lags behind the opening [s]
};

/// The parameters of a tie. Those of friction and of the ambient are of the sliding contact of nodes that have broken.
struct TieParameters : ContactParameters {
  BreakingParameters breaking;
  bool has_ambient = false;  ///< whether the model gives any value of the ambient
};

/// Whether a tie has this parameter of sliding contact, however long it lasts.
bool is_parameter_of_ties(const ParameterTag& tag);
/// Whether a parameter of sliding contact is of nodes that have broken.
bool is_parameter_of_broken_nodes(const ParameterTag& tag);

template <class Take>
void for_each_breaking_parameter(BreakingParameters& p, const Take& take) {
  using Group = ParameterGroup;
  const TakeGiven<Take> take_given{take};
  take_given({"max_traction", "strength in tension", Group::breaking, Unit::pressure}, p.max_traction);
  take_given({"max_shear", "strength in shear", Group::breaking, Unit::pressure}, p.max_shear);
  take_given({"fracture_energy", "fracture energy in tension", Group::breaking}, p.fracture_energy);
  take_given({"fracture_energy_shear", "fracture energy in shear", Group::breaking}, p.fracture_energy_shear);
  take_given({"mixing", "exponent of mixed modes", Group::breaking}, p.mixing);
  take_given({"viscosity", "time constant of damage", Group::breaking}, p.viscosity);
}

/// Calls take(tag, value) for each parameter of a tie that lasts for ever.
template <class Take>
void for_each_lasting_tie_parameter(ContactParameters& parameters, const Take& take) {
  for_each_parameter(parameters, [&](const ParameterTag& tag, auto& value) {
    if (is_parameter_of_ties(tag)) take(tag, value);
  });
}

/// Calls take(tag, value) for each parameter of a tie, but not for those of hosts_own.
template <class Take>
void for_each_tie_parameter(TieParameters& parameters, const Take& take) {
  for_each_lasting_tie_parameter(parameters, take);
  for_each_parameter(parameters, [&](ParameterTag tag, auto& value) {
    if (!is_parameter_of_broken_nodes(tag)) return;
    if (tag.group == ParameterGroup::ambient) tag.given = &parameters.has_ambient;
    take(tag, value);
  });
  for_each_breaking_parameter(parameters.breaking, take);
}

/// How the tie breaks in a step of this length [s].
mixture_contact::BreakingLaw breaking_law(const BreakingParameters& parameters, double time_step);

/// The faults of the parameters, those of breaking among them: a sentence each.
std::vector<std::string> tie_complaints(const TieParameters& parameters);

/// Sets the tie's parameters of the sliding contact of broken nodes; values that a host has found stay.
void follow_tie(ContactParameters& sliding, const TieParameters& tie);

/// The core's settings of a tie. `time_step`: in which elements store solvent [s]; 0: they do not.
mixture_contact::Settings tie_settings(const ContactParameters& parameters, SolverKind solver, double time_step,
                                       const mixture_contact::BreakingLaw& breaking = mixture_contact::Unbreakable());

/// The fields of its surfaces that a tie exchanges (see decide_exchange()); a penalty of 0 leaves out its own effect
/// alone.
Exchange tie_exchange(const ContactParameters& parameters, std::vector<FieldAtContact> fields);

/// A sentence with the number of tied primary nodes, and the reasons why others are free.
std::string tied_nodes_line(mixture_contact::Index tied, const mixture_contact::UntiedNodes& untied);
