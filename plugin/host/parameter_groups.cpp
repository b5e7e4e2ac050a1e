#include "parameter_groups.h"

#include <algorithm>
#include <vector>

namespace {

struct Group {
  const char* heading;
  std::vector<std::string> names;
};

const std::vector<Group>& groups() {
  static const std::vector<Group> all{
      {"Effects", {"effects"}},
      {"Enforcement",
       {"laugon", "penalty", "pressure_penalty", "concentration_penalty", "auto_penalty", "update_penalty", "tolerance",
        "traction_tolerance", "solvent_tolerance", "solute_tolerance", "gaptol", "ptol", "ctol", "minaug", "maxaug"}},
      {"Ambient values", {"free_draining", "ambient_pressure"}},
      {"Surfaces and integration",
       {"two_pass", "integration", "integration_order", "search_radius", "offset", "tension", "search_tol", "seg_up",
        "node_reloc", "flip_primary", "flip_secondary", "shell_bottom_primary", "shell_bottom_secondary"}},
      {"Solution", {"symmetric_stiffness", "predictor", "non_negative_concentrations", "line_search_guard"}},
      {"Friction", {"fric_coeff", "contact_frac", "tangential_penalty"}}};
  return all;
}

}  // namespace

const char* parameter_group(const std::string& name) {
  for (const Group& group : groups()) {
    if (std::find(group.names.begin(), group.names.end(), name) != group.names.end()) return group.heading;
  }
  return nullptr;
}
