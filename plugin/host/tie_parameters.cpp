#include "tie_parameters.h"

#include "contact/tie/tie.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

bool is_parameter_of_ties(const ParameterTag& tag) {
  constexpr std::array<std::string_view, 9> of_surfaces{
      "integration",    "integration_order",    "search_radius",         "search_tol", "node_reloc", "flip_primary",
      "flip_secondary", "shell_bottom_primary", "shell_bottom_secondary"};
  if (tag.group == ParameterGroup::effects || tag.group == ParameterGroup::enforcement) return true;
  return std::find(of_surfaces.begin(), of_surfaces.end(), tag.name) != of_surfaces.end();
}

mixture_contact::Settings tie_settings(const ContactParameters& p, SolverKind solver, double time_step) {
  mixture_contact::Settings settings = core_settings(p, solver);
  const auto choose = [](const Varying& given, mixture_contact::PenaltyRule& rule, double factor) {
    if (!given.given) rule.value = factor;
  };
  if (solver == SolverKind::newton)
    choose(p.penalties.traction, settings.traction, mixture_contact::default_tie_factor);
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
    text << " " << untied.too_far << " are too far away or hardly covered, at a distance of up to "
         << untied.largest_distance << ": see <search_radius>.";
  return text.str();
}
