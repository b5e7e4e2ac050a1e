#include "membrane.h"

#include <algorithm>
#include <cmath>
#include <limits>

using mixture_contact::Effects;
using mixture_contact::MembraneRule;

namespace {

bool names(const std::vector<SoluteValue>& values, int solute) {
  return std::any_of(values.begin(), values.end(), [&](const SoluteValue& value) { return value.index() == solute; });
}

std::string of_solute(int solute) { return "solute " + std::to_string(solute + 1); }

bool exchanges(const Effects& effects, int solute) {
  return std::find(effects.solutes.begin(), effects.solutes.end(), solute) != effects.solutes.end();
}

/// Adds a complaint for each solute that has the value `one` without the value `other`.
void require_both(const char* one, const std::vector<SoluteValue>& values, const char* other,
                  const std::vector<SoluteValue>& others, std::vector<std::string>& list) {
  for (const SoluteValue& value : values) {
    if (names(others, value.index())) continue;
    list.push_back("<" + std::string(one) + "> is given for " + of_solute(value.index()) + ", and <" + other +
                   "> is not. A membrane needs both; neither has a default.");
  }
}

}  // namespace

std::vector<std::string> membrane_complaints(const MembraneParameters& membrane, int solutes) {
  std::vector<std::string> list;
  const double conductance = membrane.conductance.value;
  if (!std::isfinite(conductance) || conductance < 0) {
    list.push_back("<hydraulic_conductance> is " + std::to_string(conductance) + "; it must be zero or positive.");
  }
  const double unlimited = std::numeric_limits<double>::infinity();
  for (const std::string& wrong : {complaint("solute_permeance", membrane.permeance, solutes, unlimited),
                                   complaint("reflection", membrane.reflection, solutes, 1)}) {
    if (!wrong.empty()) list.push_back(wrong);
  }
  require_both("solute_permeance", membrane.permeance, "reflection", membrane.reflection, list);
  require_both("reflection", membrane.reflection, "solute_permeance", membrane.permeance, list);
  return list;
}

std::vector<std::string> membrane_complaints(const MembraneParameters& membrane, const Effects& effects) {
  std::vector<std::string> list;
  if (!effects.solvent || membrane.conductance.given) return list;
  for (const SoluteValue& reflection : membrane.reflection) {
    if (reflection.value == 1 || !exchanges(effects, reflection.index())) continue;
    list.push_back("<reflection> of " + of_solute(reflection.index()) + " is " + std::to_string(reflection.value) +
                   ", and <hydraulic_conductance> is not given: the solvent that carries a solute through a membrane "
                   "crosses the membrane, too. Give both, or a reflection of 1.");
  }
  return list;
}

std::vector<std::string> membrane_notices(const ContactParameters& p, const Effects& effects) {
  std::vector<std::string> list;
  const MembraneParameters& membrane = p.membrane;
  if (membrane.conductance.given && membrane.conductance.value != 0 && !effects.solvent)
    list.emplace_back("<hydraulic_conductance> has no effect: no solvent crosses the contact.");
  for (const SoluteValue& permeance : membrane.permeance) {
    if (permeance.value != 0 && !exchanges(effects, permeance.index())) {
      list.push_back("<solute_permeance> of " + of_solute(permeance.index()) +
                     " has no effect: the solute does not cross the contact.");
    }
  }
  if (membrane.conductance.given && effects.solvent && p.penalties.solvent.given)
    list.emplace_back("<pressure_penalty> has no effect: the solvent crosses a membrane of <hydraulic_conductance>.");
  return list;
}

MembraneRule membrane_rule(const MembraneParameters& membrane) {
  MembraneRule rule;
  if (membrane.conductance.given) rule.conductance = membrane.conductance.value;
  for (const SoluteValue& permeance : membrane.permeance) rule.solutes[permeance.index()].permeance = permeance.value;
  for (const SoluteValue& reflection : membrane.reflection)
    rule.solutes[reflection.index()].reflection = reflection.value;
  rule.thermal_energy = membrane.thermal_energy;
  return rule;
}
