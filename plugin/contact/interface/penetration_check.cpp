#include "interface/penetration_check.h"

#include <algorithm>

namespace mixture_contact {
namespace {

/// All nodes of facets that have at least one of the given nodes.
NodeFlags nodes_of_facets_with(const NodeFlags& given, const IndexedVector<Facet>& facets) {
  NodeFlags found(given.count(), false);
  for (const Facet& facet : facets) {
    if (!any_node(facet, given)) continue;
    for (const int node : facet) found[node] = true;
  }
  return found;
}

}  // namespace

VectorXd overlap_shares(const IndexedVector<FacingNode>& nodes, const NodeFlags& primary_in_contact,
                        const IndexedVector<Facet>& primary, const Matrix3Xd& x1) {
  const NodeFlags beside_contact = nodes_of_facets_with(primary_in_contact, primary);
  VectorXd shares = VectorXd::Zero(nodes.count());
  for (Index index = 0; index < nodes.count(); ++index) {
    const FacingNode& node = nodes[index];
    if (node.facet < 0 || node.gap >= 0) continue;
    const Facet& facet = primary[node.facet];
    if (!any_node(facet, beside_contact)) shares[index] = -node.gap / longest_edge(facet, x1);
  }
  return shares;
}

UndetectedPenetration overlap_among(const IndexedVector<FacingNode>& nodes, const VectorXd& shares,
                                    const NodeFlags& but) {
  UndetectedPenetration found;
  for (Index node = 0; node < nodes.count(); ++node) {
    if (shares[node] <= penetration_tolerance || but[node]) continue;
    ++found.nodes;
    found.depth = std::max(found.depth, -nodes[node].gap);
    found.share = std::max(found.share, shares[node]);
  }
  return found;
}

NodeFlags with_entered(NodeFlags check_nodes, const IndexedVector<FacingNode>& nodes, const VectorXd& shares,
                       Index primary_facets) {
  IndexedVector<bool> entered(primary_facets, false);
  for (Index node = 0; node < nodes.count(); ++node) {
    if (shares[node] > penetration_tolerance) entered[nodes[node].facet] = true;
  }
  for (Index node = 0; node < nodes.count(); ++node) {
    if (nodes[node].facet >= 0 && entered[nodes[node].facet]) check_nodes[node] = true;
  }
  return check_nodes;
}

Settings settings_of_check(Settings settings) {
  settings.gap.tension = false;  // these nodes must not penetrate the other body, but may leave it
  if (settings.enforcement != Enforcement::lagrange_multipliers) return settings;
  settings.enforcement = Enforcement::penalty;
  settings.traction = {true, default_traction_factor};
  settings.solvent = settings.solute = {true, default_flux_factor};
  return settings;
}

}  // namespace mixture_contact
