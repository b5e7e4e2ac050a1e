#include "interface/facing_nodes.h"

#include "base/parallel.h"
#include "integration/search.h"
#include "integration/self_contact.h"

#include <algorithm>
#include <utility>

namespace mixture_contact {

Reach reach_of(const Settings& settings, const PerSide<Matrix3Xd>& position) {
  const double radius = settings.search.radius > 0 ? settings.search.radius
                                                   : std::min(half_diagonal(position[Side::primary]),
                                                              half_diagonal(position[Side::secondary]));
  return {radius, settings.search.tolerance};
}

Matrix3Xd nodal_normals(const SurfaceMesh& mesh, const Matrix3Xd& position) {
  Matrix3Xd normals = Matrix3Xd::Zero(3, mesh.nodes);
  for (const Facet& facet : mesh.facets) {
    const FacetCoordinates x = facet_coordinates(facet, position);
    for (int a = 0; a < facet.count(); ++a) {
      const Eigen::Matrix<double, 3, 2> tangents = x * gradient_at_node(facet.type, a);
      normals.col(facet.node(a)) += tangents.col(0).cross(tangents.col(1));
    }
  }
  normals.colwise().normalize();
  return normals;
}

IndexedVector<FacingNode> facing_nodes(const SidedPass& pass, const PerSide<SurfaceMesh>& mesh,
                                       const PerSide<Matrix3Xd>& position, const NodeFlags& in_contact,
                                       const Reach& reach) {
  const double least_share = pass.integral->active_set().options().contact_share;
  const Side side = other(pass.side);
  IndexedVector<FacingNode> nodes(mesh[side].nodes);
  if (!surfaces_within_reach(position[side], position[pass.side], reach.distance)) return nodes;
  const IndexedVector<Facet>& facets = mesh[pass.side].facets;
  const FacetTree tree(facets, position[pass.side], box_margin);
  const Matrix3Xd normals = nodal_normals(mesh[side], position[side]);
  const VectorXd share = VectorXd::NullaryExpr(in_contact.count(),
                                               [&](Index node) { return in_contact[node] ? 1.0 : 0.0; });
  const VectorXd overlaps = largest_overlaps_of_nodes(mesh[side]);
  in_parallel(nodes.count(), [&](Index node) {
    Ray ray{position[side].col(node), normals.col(node), reach.distance, reach.tolerance};
    if (overlaps.size() > 0) {
      ray.overlap = overlaps[node];
      ray.opposition = SelfContact::least_opposition;
    }
    const std::optional<SurfaceHit> hit = nearest_facing_or_passed(tree, facets, position[pass.side], ray);
    if (!hit) return;
    const Facet& facet = facets[hit->facet];
    const FacetVector
        psi = pass.integral->space().shape(hit->facet, sub_facet_at(facet.type, hit->eta), hit->eta).value;
    nodes[node] = {hit->facet, hit->gap, psi.dot(facet_values(facet, share)) >= least_share};
  });
  return nodes;
}

NodeFlags in_contact_of(const IndexedVector<FacingNode>& nodes) {
  NodeFlags in_contact;
  for (const FacingNode& node : nodes) in_contact.push_back(node.in_contact);
  return in_contact;
}

NodeFlags next_facing(const SidedPass& pass, NodeFlags facing) {
  if (!pass.faced) return facing;
  const int most_changes = pass.integral->active_set().options().most_facing_changes;
  for (Index node = 0; node < facing.count(); ++node) {
    const int changes = pass.faced_changes[node] + (facing[node] != (*pass.faced)[node] ? 1 : 0);
    if (changes > most_changes) facing[node] = false;
  }
  return facing;
}

void hold_facing(SidedPass& pass, const NodeFlags& facing) {
  NodeFlags next = next_facing(pass, facing);
  if (!pass.faced) pass.faced_changes.assign(facing.size(), 0);
  for (Index node = 0; node < facing.count(); ++node) {
    if (pass.faced && facing[node] != (*pass.faced)[node]) ++pass.faced_changes[node];
  }
  pass.faced = std::move(next);
}

}  // namespace mixture_contact
