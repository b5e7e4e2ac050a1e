#include "interface/penetration_check.h"

#include "base/lists.h"
#include "integration/facing_share.h"

#include <algorithm>
#include <cmath>
#include <optional>

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

/// The angle between facets for which penetration_tolerance is derived [rad].
constexpr double largest_turn = 8 * penetration_tolerance;
/// A larger angle between facets with a common node is an edge of the body [rad].
constexpr double smallest_fold = 1;

/// The largest angle between a facet and the facets at its nodes, without folds [rad].
double turn(const Facet& facet, const Lists<int>& around, const IndexedVector<Facet>& facets, const Matrix3Xd& x) {
  const Vector3d normal = middle_normal(facet, x);
  double largest = 0;
  for (const int node : facet) {
    for (const int other : around[node]) {
      const Vector3d next = middle_normal(facets[other], x);
      const double angle = std::atan2(normal.cross(next).norm(), normal.dot(next));
      if (angle < smallest_fold) largest = std::max(largest, angle);
    }
  }
  return largest;
}

/// Per node, the facets around it.
Lists<int> facets_around(const SurfaceMesh& mesh) {
  return {mesh.nodes, [&](const auto& add) {
            for (int facet = 0; facet < mesh.facets.count(); ++facet) {
              for (const int node : mesh.facets[facet]) add(node, facet);
            }
          }};
}

}  // namespace

VectorXd overlap_shares(const IndexedVector<FacingNode>& nodes, const NodeFlags& primary_in_contact,
                        const PerSide<SurfaceMesh>& mesh, const PerSide<Matrix3Xd>& position) {
  const IndexedVector<Facet>& primary = mesh[Side::primary].facets;
  const Matrix3Xd& x1 = position[Side::primary];
  const NodeFlags beside_contact = nodes_of_facets_with(primary_in_contact, primary);
  const VectorXd own = longest_edges(mesh[Side::secondary], position[Side::secondary]);
  std::optional<Lists<int>> around;
  const auto length = [&](Index node, double overlap) {
    const Facet& facet = primary[nodes[node].facet];
    const double edge = longest_edge(facet, x1);
    const double least = std::min(own[node], edge);
    if (overlap <= penetration_tolerance * least) return edge;  // within the tolerance for any length
    if (!around) around = facets_around(mesh[Side::primary]);
    return std::clamp(edge * turn(facet, *around, primary, x1) / largest_turn, least, edge);
  };
  VectorXd shares = VectorXd::Zero(nodes.count());
  for (Index node = 0; node < nodes.count(); ++node) {
    const double overlap = -nodes[node].gap;
    if (nodes[node].facet < 0 || overlap <= 0) continue;
    if (!any_node(primary[nodes[node].facet], beside_contact)) shares[node] = overlap / length(node, overlap);
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
