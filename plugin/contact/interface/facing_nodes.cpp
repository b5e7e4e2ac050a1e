#include "interface/facing_nodes.h"

#include "base/parallel.h"
#include "integration/search.h"

#include <utility>

namespace mixture_contact {
namespace {

/// As ActiveSetOptions::most_status_changes, for nodes of the surface that faces the primary one, a change earlier. One
/// that went and came back is not at the edge: where a surface slides over a finer one many do, and they would empty it
/// into the ambient.
constexpr int most_facing_changes = 2;

/// A node counts as in contact where the contact of the nodes facing it, by the pass over their surface and
/// interpolated, reaches this share; with two passes also where its own pass has it in contact.
constexpr double covered = 0.5 - 1e-9;

/// Outward unit normals at the nodes: the sum of the area vectors of the facets around each.
Matrix3Xd nodal_normals(const SurfaceMesh& mesh, const Matrix3Xd& position) {
  Matrix3Xd normals = Matrix3Xd::Zero(3, mesh.nodes);
  for (const Facet& facet : mesh.facets) {
    const FacetCoordinates x = facet_coordinates(facet, position);
    for (int a = 0; a < facet.count(); ++a) {
      const Eigen::Matrix<double, 3, 2> tangents = x *
                                                   shape_functions(facet.type, parametric_node(facet.type, a)).gradient;
      normals.col(facet.node(a)) += tangents.col(0).cross(tangents.col(1));
    }
  }
  normals.colwise().normalize();
  return normals;
}

}  // namespace

IndexedVector<FacingNode> facing_nodes(const SidedPass& pass, const PerSide<SurfaceMesh>& mesh,
                                       const PerSide<Matrix3Xd>& position, const NodeFlags& in_contact,
                                       const Reach& reach) {
  const Side side = other(pass.side);
  IndexedVector<FacingNode> nodes(mesh[side].nodes);
  if (!surfaces_within_reach(position[side], position[pass.side], reach.distance)) return nodes;
  const IndexedVector<Facet>& facets = mesh[pass.side].facets;
  const FacetTree tree(facets, position[pass.side], box_margin);
  const Matrix3Xd normals = nodal_normals(mesh[side], position[side]);
  const VectorXd share = VectorXd::NullaryExpr(in_contact.count(),
                                               [&](Index node) { return in_contact[node] ? 1.0 : 0.0; });
  in_parallel(nodes.count(), [&](Index node) {
    const Ray ray{position[side].col(node), normals.col(node), reach.distance, reach.tolerance};
    const std::optional<SurfaceHit> hit = nearest_facing_or_passed(tree, facets, position[pass.side], ray);
    if (!hit) return;
    const Facet& facet = facets[hit->facet];
    const FacetVector
        psi = pass.integral->space().shape(hit->facet, sub_facet_at(facet.type, hit->eta), hit->eta).value;
    nodes[node] = {hit->facet, hit->gap, psi.dot(facet_values(facet, share)) >= covered};
  });
  return nodes;
}

NodeFlags in_contact_of(const IndexedVector<FacingNode>& nodes) {
  NodeFlags in_contact;
  for (const FacingNode& node : nodes) in_contact.push_back(node.in_contact);
  return in_contact;
}

void hold_facing(SidedPass& pass, NodeFlags facing) {
  if (!pass.faced) pass.faced_changes.assign(facing.size(), 0);
  for (Index node = 0; node < facing.count(); ++node) {
    if (pass.faced && facing[node] != (*pass.faced)[node]) ++pass.faced_changes[node];
    if (pass.faced_changes[node] > most_facing_changes) facing[node] = false;
  }
  pass.faced = std::move(facing);
}

Matrix3Xd moved_out_of_overlap(const PerSide<SurfaceMesh>& mesh, const PerSide<Matrix3Xd>& position,
                               const Reach& reach) {
  const IndexedVector<Facet>& facets = mesh[Side::secondary].facets;
  const Matrix3Xd& x2 = position[Side::secondary];
  const FacetTree tree(facets, x2, box_margin);
  Matrix3Xd moved = position[Side::primary];
  const Matrix3Xd normals = nodal_normals(mesh[Side::primary], moved);
  for (Index node = 0; node < moved.cols(); ++node) {
    const Ray ray{moved.col(node), normals.col(node), reach.distance, reach.tolerance};
    const std::optional<SurfaceHit> hit = nearest_facing_or_passed(tree, facets, x2, ray);
    if (hit && hit->gap < 0) moved.col(node) += hit->gap * normals.col(node);
  }
  return moved;
}

}  // namespace mixture_contact
