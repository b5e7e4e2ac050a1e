#include "cohesive_zone.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

using namespace mixture_contact;

namespace {

/// The modulus of the softest element behind the facets [MPa]; infinite if all are rigid.
double least_modulus(const FacetMaterials& materials) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::vector<FacetMaterial>& of_side : materials) {
    for (const FacetMaterial& each : of_side) {
      if (each.stiffness > 0 && std::isfinite(each.stiffness)) least = std::min(least, each.stiffness * each.thickness);
    }
  }
  return least;
}

}  // namespace

std::string penalty_complaint(const Tie& tie) {
  const auto* const law = std::get_if<Cohesive>(&tie.breaking());
  if (law == nullptr) return "";
  double least = std::numeric_limits<double>::infinity();
  for (Index n = 0; n < tie.nodes().count(); ++n) least = std::min(least, tie.traction_penalty(n));
  const double needed = least_penalty(*law);
  if (least > needed) return "";
  std::ostringstream text;
  text << "the penalty of the tie is " << least
       << " at some node, and a bond with this strength and <fracture_energy> needs "
       << "more than " << needed << " (strength^2/(2 energy)) to soften. Set <penalty> to several times that and "
       << "<auto_penalty> to 0.";
  return text.str();
}

double cohesive_zone(const Cohesive& law, double modulus) {
  const ByMode& limit = law.strength.traction;
  return modulus *
         std::min(law.energy.normal / (limit.normal * limit.normal), law.energy.shear / (limit.shear * limit.shear));
}

std::string cohesive_zone_line(const Tie& tie, const FacetMaterials& materials, const PerSide<Matrix3Xd>& position) {
  const auto* const law = std::get_if<Cohesive>(&tie.breaking());
  if (law == nullptr) return "";
  double longest = 0;
  for (const Facet& facet : tie.mesh()[Side::primary].facets)
    longest = std::max(longest, longest_edge(facet, position[Side::primary]));
  const double zone = cohesive_zone(*law, least_modulus(materials));
  if (zone >= facets_in_cohesive_zone * longest) return "";
  std::ostringstream text;
  text
      << "bonds soften over a length of about " << zone << " (modulus energy/strength^2), and facets are up to "
      << longest
      << " long. At least three facets should span this length: with fewer, the load oscillates and steps fail. Refine "
      << "the surface, or choose a smaller <max_traction>, which hardly changes the growth of a crack.";
  return text.str();
}

std::string failed_softening_line(const std::string& tie) {
  return tie +
         ": bonds soften in the step that has failed. FEBio repeats it with a line search. A step in which a crack jumps "
         "over several nodes takes 50 to 100 iterations: set <max_refs> to 150, <max_ups> and <lstol> to 0, and <dtol> to "
         "1e-6. If steps still fail, set <viscosity> to a tenth of the time step, or use finer facets. The log reports "
         "this once in a run.";
}
