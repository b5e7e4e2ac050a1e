#include "interface/contact_state.h"

#include <stdexcept>
#include <string>

namespace mixture_contact {
namespace {

bool fits(const LoadCarriers& carriers, const IndexedVector<Facet>& facets) {
  if (carriers.empty()) return true;
  if (carriers.count() != facets.count()) return false;
  for (Index f = 0; f < facets.count(); ++f) {
    if (carriers[f].size() > 0 && carriers[f].size() != facets[f].count()) return false;
  }
  return true;
}

}  // namespace

void check(const ContactState& state, const PerSide<SurfaceMesh>& mesh, const Effects& effects, bool two_pass) {
  const auto require = [](bool sound, const std::string& what) {
    if (!sound) throw std::invalid_argument("a stored state of the contact does not fit it: " + what);
  };
  for (const int node : state.check_nodes) {
    require(node >= 0 && node < mesh[Side::secondary].nodes, "secondary node " + std::to_string(node));
  }
  require(!two_pass || state.check_nodes.empty(), "penetration-check nodes with two passes");
  const std::size_t passes = two_pass || !state.check_nodes.empty() ? 2 : 1;
  require(state.multipliers.size() == passes, "multipliers of " + std::to_string(state.multipliers.size()) + " passes");
  for (std::size_t pass = 0; pass < passes; ++pass) {
    require(fits(state.multipliers[pass], mesh[both_sides.at(pass)].nodes, effects),
            "multipliers of pass " + std::to_string(pass));
  }
  for (const Side side : both_sides) {
    const Index nodes = state.slips_from[side].cols();
    require(nodes == 0 || nodes == mesh[side].nodes, "start positions of slips");
  }
  require(state.carriers.size() == passes, "load carriers of " + std::to_string(state.carriers.size()) + " passes");
  for (std::size_t pass = 0; pass < passes; ++pass) {
    require(fits(state.carriers[pass], mesh[both_sides.at(pass)].facets),
            "load carriers of pass " + std::to_string(pass));
  }
  require(state.faced.size() == passes, "facing nodes of " + std::to_string(state.faced.size()) + " passes");
  for (std::size_t pass = 0; pass < passes; ++pass) {
    const NodeFlags& faced = state.faced[pass];
    require(faced.empty() || faced.count() == mesh[other(both_sides.at(pass))].nodes,
            "facing nodes of pass " + std::to_string(pass));
  }
}

}  // namespace mixture_contact
