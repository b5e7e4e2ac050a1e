/// The parameters of <contact type="tied-mixture"> in a model file: some of those of sliding contact with the same
/// names and meaning, and those of breaking.
#pragma once

#include "contact/tie/breaking.h"
#include "contact/tie/tied_node.h"
#include "contact_parameters.h"
#include "exchange.h"

#include <string>
#include <vector>

/// Parameters of breaking. A tie without a strength never breaks.
struct BreakingParameters {
  Given<double> max_traction;           ///< sigma_c, strength in tension [MPa]
  Given<double> max_shear;              ///< tau_c, strength in shear [MPa]; default: sigma_c
  Given<double> fracture_energy;        ///< G_n, fracture energy in tension [N/mm]
  Given<double> fracture_energy_shear;  ///< G_s, fracture energy in shear [N/mm]; default: G_n
  Given<double> mixing{2};              ///< eta, exponent of mixed modes [-]
  Given<double> viscosity;              ///< tau, time constant of damage [s]
};

/// The parameters of a tie. Those of friction and of ambient values apply to the sliding contact of broken nodes.
struct TieParameters : ContactParameters {
  BreakingParameters breaking;
  bool has_ambient = false;  ///< true if the model sets a parameter of ambient values
};

/// True if a tie has this parameter of sliding contact, whether it can break or not.
bool is_parameter_of_ties(const ParameterTag& tag);
/// True if a parameter of sliding contact applies to broken nodes only.
bool is_parameter_of_broken_nodes(const ParameterTag& tag);

/// Calls take(tag, value) for each parameter of the law by which a tie breaks.
template <class Take>
void for_each_breaking_parameter(BreakingParameters& p, const Take& take) {
  using Group = ParameterGroup;
  const TakeGiven<Take> take_given{take};
  take_given({"max_traction", "strength in tension", Group::breaking, Unit::pressure}, p.max_traction);
  take_given({"max_shear", "strength in shear", Group::breaking, Unit::pressure}, p.max_shear);
  take_given({"fracture_energy", "fracture energy in tension", Group::breaking, Unit::energy_per_area},
             p.fracture_energy);
  take_given({"fracture_energy_shear", "fracture energy in shear", Group::breaking, Unit::energy_per_area},
             p.fracture_energy_shear);
  take_given({"mixing", "exponent of mixed modes", Group::breaking}, p.mixing);
  take_given({"viscosity", "time constant of damage", Group::breaking, Unit::time}, p.viscosity);
}

/// Calls take(tag, value) for each parameter of a tie that cannot break.
template <class Take>
void for_each_lasting_tie_parameter(ContactParameters& parameters, const Take& take) {
  for_each_parameter(parameters, [&](const ParameterTag& tag, auto& value) {
    if (is_parameter_of_ties(tag)) take(tag, value);
  });
}

/// Calls take(tag, value) for each parameter of a tie. Parameters in hosts_own are not included.
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

/// The law by which the tie breaks, in a step of length `time_step` [s].
mixture_contact::BreakingLaw breaking_law(const BreakingParameters& parameters, double time_step);

/// The faults of the parameters, including those of breaking, one sentence each.
std::vector<std::string> tie_complaints(const TieParameters& parameters);

/// Sets the parameters of the sliding contact of broken nodes to those of the tie. Values that the host has determined
/// stay the same.
void follow_tie(ContactParameters& sliding, const TieParameters& tie);

/// The core's settings of a tie. `time_step`: in which elements store solvent [s]; 0: without storage.
mixture_contact::Settings tie_settings(const ContactParameters& parameters, SolverKind solver, double time_step,
                                       const mixture_contact::BreakingLaw& breaking = mixture_contact::Unbreakable());

/// The effects that a tie exchanges (see decide_exchange()). A penalty of 0 removes only its own effect.
Exchange tie_exchange(const ContactParameters& parameters, std::vector<FieldAtContact> fields);

/// A sentence with the number of tied primary nodes, and the reasons why others are not tied.
std::string tied_nodes_line(mixture_contact::Index tied, const mixture_contact::UntiedNodes& untied);
