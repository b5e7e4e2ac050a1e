#include "tie_parameters.h"

#include "contact/tie/tie.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string_view>
#include <utility>

bool is_parameter_of_ties(const ParameterTag& tag) {
  constexpr std::array<std::string_view, 9> of_surfaces{
      "integration",    "integration_order",    "search_radius",         "search_tol", "node_reloc", "flip_primary",
      "flip_secondary", "shell_bottom_primary", "shell_bottom_secondary"};
  if (std::string_view(tag.name) == "solver_devices" || tag.group == ParameterGroup::effects ||
      tag.group == ParameterGroup::enforcement)
    return true;
  return std::find(of_surfaces.begin(), of_surfaces.end(), tag.name) != of_surfaces.end();
}

bool is_parameter_of_broken_nodes(const ParameterTag& tag) {
  return tag.group == ParameterGroup::friction || tag.group == ParameterGroup::ambient;
}

mixture_contact::BreakingLaw breaking_law(const BreakingParameters& p, double time_step) {
  using namespace mixture_contact;
  if (!p.max_traction.given) return Unbreakable();
  const auto by_mode = [](const Given<double>& normal, const Given<double>& shear) {
    return ByMode{normal.value, shear.given ? shear.value : normal.value};
  };
  const ByMode strength = by_mode(p.max_traction, p.max_shear);
  if (!p.fracture_energy.given) return Brittle{strength};
  const double pace = p.viscosity.value > 0 && time_step > 0 ? time_step / (time_step + p.viscosity.value) : 1.0;
  return Cohesive{{strength, p.mixing.value}, by_mode(p.fracture_energy, p.fracture_energy_shear), pace};
}

namespace {

void complain_of_values(std::vector<std::string>& list, const BreakingParameters& p) {
  const auto require = [&](const char* name, const Given<double>& value, double least, const char* allowed) {
    const bool is_sound = std::isfinite(value.value) && (least > 0 ? value.value >= least : value.value > 0);
    if (value.given && !is_sound)
      list.push_back("<" + std::string(name) + "> is " + std::to_string(value.value) + "; it must be " + allowed + ".");
  };
  require("max_traction", p.max_traction, 0, "a positive number");
  require("max_shear", p.max_shear, 0, "a positive number");
  require("fracture_energy", p.fracture_energy, 0, "a positive number");
  require("fracture_energy_shear", p.fracture_energy_shear, 0, "a positive number");
  require("mixing", p.mixing, 1, "a number of at least 1");
  require("viscosity", p.viscosity, 0, "a positive number");
}

void complain_of_lacking(std::vector<std::string>& list, const BreakingParameters& p) {
  const auto require = [&](bool given, const char* name, bool has, const char* other) {
    if (given && !has) list.push_back("<" + std::string(name) + "> is set without <" + other + ">, which it needs.");
  };
  const bool may_break = p.max_traction.given;
  require(p.max_shear.given, "max_shear", may_break, "max_traction");
  require(p.fracture_energy.given, "fracture_energy", may_break, "max_traction");
  require(p.fracture_energy_shear.given, "fracture_energy_shear", p.fracture_energy.given, "fracture_energy");
  require(p.mixing.given, "mixing", p.fracture_energy.given, "fracture_energy");
  require(p.viscosity.given, "viscosity", p.fracture_energy.given, "fracture_energy");
}

/// Adds complaints about parameters of the sliding contact of broken nodes if the tie cannot break.
void complain_of_sliding(std::vector<std::string>& list, const TieParameters& p) {
  if (p.breaking.max_traction.given) return;
  const auto refuse = [&](bool given, const std::string& name) {
    if (given)
      list.push_back(
          name +
          " is set, and the tie cannot break: this parameter affects broken nodes alone. Set <max_traction>, "
          "or delete this parameter.");
  };
  refuse(p.friction.fric_coeff.given, "<fric_coeff>");
  refuse(p.friction.contact_frac.given, "<contact_frac>");
  refuse(p.friction.tangential_penalty.given, "<tangential_penalty>");
  refuse(p.has_ambient, "An ambient value");
}

}  // namespace

std::vector<std::string> tie_complaints(const TieParameters& p) {
  std::vector<std::string> list = complaints(p);
  complain_of_values(list, p.breaking);
  complain_of_lacking(list, p.breaking);
  complain_of_sliding(list, p);
  const bool is_penalty = core_settings(p).enforcement == mixture_contact::Enforcement::penalty;
  if (p.breaking.fracture_energy.given && !is_penalty)
    list.emplace_back(
        "<fracture_energy> is set with AUGLAG or LAGMULT: a bond that softens needs <laugon>PENALTY</laugon>, whose "
        "penalty is its initial stiffness. Ties without <fracture_energy> may have any <laugon>.");
  if (p.breaking.max_traction.given && left_out(p).contact)
    list.emplace_back("<penalty> is 0 with <max_traction>: without a traction nothing can break.");
  return list;
}

void follow_tie(ContactParameters& sliding, const TieParameters& tie) {
  ContactParameters next;
  next.effects = tie.effects;
  next.enforcement.laugon = tie.enforcement.laugon;
  next.enforcement.minaug = tie.enforcement.minaug;
  next.enforcement.maxaug = tie.enforcement.maxaug;
  next.tolerances = tie.tolerances;
  next.penalties = tie.penalties;
  next.integration = tie.integration;
  next.search.tolerance = tie.search.tolerance;
  for (const mixture_contact::Side side : mixture_contact::both_sides)
    next.surfaces[side].shell_bottom = tie.surfaces[side].shell_bottom;
  next.ambient = tie.ambient;
  next.friction = tie.friction;
  next.helpers.devices = tie.helpers.devices;
  next.membrane = sliding.membrane;
  sliding = std::move(next);
}

mixture_contact::Settings tie_settings(const ContactParameters& p, SolverKind solver, double time_step,
                                       const mixture_contact::BreakingLaw& breaking) {
  mixture_contact::Settings settings = core_settings(p, solver);
  const auto choose = [](const Varying& given, mixture_contact::PenaltyRule& rule, double factor) {
    if (!given.given) rule.value = factor;
  };
  const bool is_cohesive = std::holds_alternative<mixture_contact::Cohesive>(breaking);
  if (solver == SolverKind::newton)
    choose(p.penalties.traction, settings.traction,
           is_cohesive ? mixture_contact::default_cohesive_factor : mixture_contact::default_tie_factor);
  choose(p.penalties.solvent, settings.solvent, mixture_contact::default_tie_flux_factor);
  choose(p.penalties.solute, settings.solute, mixture_contact::default_tie_flux_factor);
  settings.solvent.time_step = time_step;
  return settings;
}

Exchange tie_exchange(const ContactParameters& p, std::vector<FieldAtContact> fields) {
  LeftOut zeros = left_out(p);
  const bool has_traction = !zeros.contact;
  zeros.contact = false;
  leave_out(zeros, fields);
  return decide_exchange(p.effects, fields, has_traction ? Motion::tied : Motion::untouched);
}

std::string tied_nodes_line(mixture_contact::Index tied, const mixture_contact::UntiedNodes& untied) {
  std::ostringstream text;
  text << "ties " << tied << " of " << tied + untied.count() << " primary nodes.";
  if (untied.facing_nothing > 0) text << " " << untied.facing_nothing << " face nothing.";
  if (untied.too_far > 0)
    text << " " << untied.too_far
         << " are too far from the secondary surface or hardly covered by it, at a distance of up to "
         << untied.largest_distance << ": see <search_radius>.";
  return text.str();
}
