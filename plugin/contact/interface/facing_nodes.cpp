#include "interface/facing_nodes.h"

#include "base/parallel.h"
#include "geometry/sub_facets.h"
#include "integration/search.h"
#include "integration/self_contact.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mixture_contact {
namespace {

/// The search distance ahead of each node: the largest one of the facets around it.
VectorXd farthest_ahead(const SurfaceMesh& mesh, const Matrix3Xd& position, const Reach& reach) {
  VectorXd ahead = VectorXd::Zero(mesh.nodes);
  for (const Facet& facet : mesh.facets) {
    const double of_facet = reach.ahead(facet, position);
    for (const int node : facet) ahead[node] = std::max(ahead[node], of_facet);
  }
  return ahead;
}

}  // namespace

Reach reach_of(const Settings& settings, const FacingPositions& x) {
  if (settings.search.radius > 0) return settings.search.radius;
  const double half = std::min(half_diagonal(x.primary), half_diagonal(x.secondary));
  return normal_condition(settings.gap).may_part() ? Reach(half, settings.gap.offset) : Reach(half);
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

IndexedVector<std::optional<SurfaceHit>> hits_of_nodes(const SurfaceMesh& own, const SurfaceMesh& other,
                                                       const FacingPositions& x, const Reach& reach, double tolerance) {
  IndexedVector<std::optional<SurfaceHit>> hits(own.nodes);
  if (!surfaces_within_reach(x.primary, x.secondary, reach.backwards())) return hits;
  const FacetTree tree(other.facets, x.secondary, box_margin);
  Visibility visibility(own, other);
  visibility.move_to(x.primary, x.secondary);
  const Matrix3Xd normals = nodal_normals(own, x.primary);
  const VectorXd ahead = farthest_ahead(own, x.primary, reach);
  const VectorXd overlaps = largest_overlaps_of_nodes(own);
  in_parallel(hits.count(), [&](Index node) {
    Ray ray{x.primary.col(node), normals.col(node), reach.distance, tolerance};
    ray.beyond = reach.beyond;
    if (own.may_meet_itself()) {
      ray.overlap = overlaps[node];
    } else {
      ray.ahead = ahead[node];
    }
    hits[node] = nearest_facing_or_passed(tree, other.facets, x.secondary, ray, [&](const SurfaceHit& hit) {
      return !visibility.is_hidden(ray.origin, ray.direction, hit.gap, Visibility::node, hit.facet);
    });
  });
  return hits;
}

IndexedVector<std::optional<SurfaceHit>> hits_of_nodes(const SurfaceMesh& own, const SurfaceMesh& other,
                                                       const FacingPositions& x, const Settings& settings) {
  return hits_of_nodes(own, other, x, reach_of(settings, x), settings.search.tolerance);
}

IndexedVector<FacingNode> facing_nodes(const SidedPass& pass, const PerSide<SurfaceMesh>& mesh,
                                       const PerSide<Matrix3Xd>& position, const NodeFlags& in_contact,
                                       const Settings& settings) {
  if (!pass.hits) {
    pass.hits = hits_of_nodes(mesh[other(pass.side)], mesh[pass.side], seen_from(other(pass.side), position),
                              pass.reach, settings.search.tolerance);
  }
  const IndexedVector<std::optional<SurfaceHit>>& hits = *pass.hits;
  const VectorXd share = VectorXd::NullaryExpr(in_contact.count(),
                                               [&](Index node) { return in_contact[node] ? 1.0 : 0.0; });
  IndexedVector<FacingNode> nodes(hits.size());
  in_parallel(nodes.count(), [&](Index node) {
    const std::optional<SurfaceHit>& hit = hits[node];
    if (!hit) return;
    const Facet& facet = mesh[pass.side].facets[hit->facet];
    const FacetVector
        psi = pass.integral->space().shape(hit->facet, sub_facet_at(facet.type, hit->eta), hit->eta).value;
    nodes[node] = {hit->facet, hit->gap, psi.dot(facet_values(facet, share))};
  });
  return nodes;
}

NodeFlags facing_contact(const SidedPass& pass, const IndexedVector<FacingNode>& nodes) {
  const double least_share = pass.integral->active_set().options().contact_share;
  NodeFlags facing;
  for (const FacingNode& node : nodes) facing.push_back(node.share >= least_share);
  return facing;
}

NodeFlags facing_contact_in_step(const SidedPass& pass, const IndexedVector<FacingNode>& nodes) {
  const ActiveSetOptions& options = pass.integral->active_set().options();
  NodeFlags facing = facing_contact(pass, nodes);
  if (pass.faced_before.empty()) return facing;
  for (Index node = 0; node < nodes.count(); ++node) {
    const bool is_near = std::abs(nodes[node].share - options.contact_share) < options.contact_share_margin;
    if (is_near) facing[node] = pass.faced_before[node];
  }
  return facing;
}

NodeFlags next_facing(const SidedPass& pass, NodeFlags facing) {
  if (!pass.faced) return facing;
  const int most_changes = pass.integral->active_set().options().most_status_changes;
  for (Index node = 0; node < facing.count(); ++node) {
    const int changes = pass.faced_changes[node] + (facing[node] != (*pass.faced)[node] ? 1 : 0);
    if (changes > most_changes) facing[node] = false;
  }
  return facing;
}

void hold_facing(SidedPass& pass, const NodeFlags& facing) {
  NodeFlags next = next_facing(pass, facing);
  if (!pass.faced) {
    pass.faced_changes.assign(facing.size(), 0);
    pass.has_reconsidered = false;
  }
  for (Index node = 0; node < facing.count(); ++node) {
    if (pass.faced && facing[node] != (*pass.faced)[node]) ++pass.faced_changes[node];
  }
  pass.faced = std::move(next);
}

NodeFlags with_joined(NodeFlags nodes, const SurfaceMesh& mesh) {
  for (Index node = 0; node < nodes.count(); ++node) nodes[node] = nodes[node] || mesh.is_joined(node);
  return nodes;
}

bool reconsiders_facing(SidedPass& pass, const NodeFlags& facing) {
  if (!pass.faced || facing == *pass.faced || std::exchange(pass.has_reconsidered, true)) return false;
  pass.faced_changes.assign(facing.size(), 0);
  return true;
}

}  // namespace mixture_contact
