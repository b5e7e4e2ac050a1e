/// A contact surface as data: its facets, the fields to which they are permeable, and the values at its nodes.
#pragma once

#include "base/effects.h"
#include "base/indexed_vector.h"
#include "base/side.h"
#include "geometry/facet.h"
#include "geometry/rigid_motion.h"

#include <algorithm>
#include <vector>

namespace mixture_contact {

/// The part of a surface that is constant in a run: the facets, and the properties of the material behind each facet.
struct SurfaceMesh {
  int nodes = 0;
  IndexedVector<Facet> facets;
  /// Per facet: the exchanged scalar fields to which the material behind the facet is permeable.
  IndexedVector<FieldMask> permeable;
  VectorXd stiffness;    ///< per facet: normal stiffness modulus over element thickness [N/mm^3]; infinite if rigid
  MatrixXd conductance;  ///< (scalar fields, facets): conductance over element thickness; 0 if impermeable

  // Nodes have numbers only if a body may meet itself, because its two surfaces then have facets in common.
  IndexedVector<int> node_ids;  ///< per node: its number in the host's mesh, the same for both surfaces
  VectorXd thickness;           ///< per facet: thickness of the element behind it [mm]; empty if unknown

  /// Per node: true if both surfaces contain the node, without self-contact; empty if there is no such node.
  NodeFlags joined;
  /// Per node: true if no solution can move the node, because its displacements are prescribed or its rigid body cannot
  /// move; empty if the host has not said so.
  NodeFlags immovable;

  bool may_meet_itself() const { return node_ids.count() > 0; }
  /// True if both surfaces contain the node. Such a node cannot open and has no ambient values.
  bool is_joined(Index node) const { return joined.count() > 0 && joined[node]; }
};

/// The primary nodes whose gap no solution can change: they are immovable, and so are all secondary nodes. Empty if
/// there is none, or if no primary node can move.
NodeFlags nodes_of_fixed_gap(const SurfaceMesh& primary, const SurfaceMesh& secondary);

/// True if all nodes of a surface are joined with the other surface.
bool are_all_joined(const SurfaceMesh& mesh);

/// Sets SurfaceMesh::joined, the nodes that both surfaces contain. `numbers`: for each surface, the numbers of its
/// nodes in the host's mesh.
void find_joined_nodes(PerSide<SurfaceMesh>& meshes, const PerSide<std::vector<int>>& numbers);

/// The current positions and field values at the nodes of a surface.
struct SurfaceFields {
  Matrix3Xd position;  ///< current positions, shape (3, nodes) [mm]
  /// Scalar fields, shape (nodes, fields): p~ [MPa] and c~ [mM] in the order of Effects; then the p~ that only friction
  /// reads, if any (Effects::nodal_fields).
  MatrixXd scalar;
  RigidParts rigid = {};  ///< the rigid bodies that can move

  std::size_t memory() const;  ///< memory of the values [bytes]
};

/// Positions, or positions and fields, of the primary and secondary surface of a pass.
using FacingPositions = Facing<Matrix3Xd>;
/// The facets of both surfaces in one pass.
using FacingFacets = Facing<IndexedVector<Facet>>;
using FacingFields = Facing<SurfaceFields>;
inline FacingPositions positions(const FacingFields& fields) {
  return {fields.primary.position, fields.secondary.position};
}

/// True if a node of the facet is among the given nodes.
inline bool any_node(const Facet& facet, const NodeFlags& given) {
  return std::any_of(facet.begin(), facet.end(), [&](int node) { return given[node]; });
}

/// INT psi_a da over one facet for each of its nodes, shape (n) [mm^2].
FacetVector areas_of_nodes(const Facet& facet, const Matrix3Xd& position);

/// INT psi_a da for each node, over all facets around it, shape (nodes) [mm^2].
VectorXd nodal_areas(const SurfaceMesh& mesh, const Matrix3Xd& position);

/// The longest distance between neighbouring corners of a facet [length].
double longest_edge(const Facet& facet, const Matrix3Xd& position);
/// The longest edge of the facets around each node; 0 for nodes without facets [length].
VectorXd longest_edges(const SurfaceMesh& mesh, const Matrix3Xd& position);

/// Half the diagonal of the box around all nodes [length].
double half_diagonal(const Matrix3Xd& position);

}  // namespace mixture_contact
