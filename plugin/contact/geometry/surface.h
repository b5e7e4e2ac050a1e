/// A contact surface as data: facets, the fields that they let through, and the values at its nodes.
#pragma once

#include "base/effects.h"
#include "base/indexed_vector.h"
#include "base/side.h"
#include "geometry/facet.h"

#include <algorithm>
#include <vector>

namespace mixture_contact {

/// The part of a surface that a run does not change: facets, and the properties of the material behind each.
struct SurfaceMesh {
  int nodes = 0;
  IndexedVector<Facet> facets;
  IndexedVector<FieldMask> permeable;  ///< per facet: the exchanged scalar fields of the material behind it
  VectorXd stiffness;    ///< per facet: normal stiffness modulus over element thickness [N/mm^3]; infinite if rigid
  MatrixXd conductance;  ///< (scalar fields, facets): conductance over thickness; 0 where impermeable

  // Nodes have numbers if a body may meet itself, since both surfaces have facets in common; else none has.
  IndexedVector<int> node_ids;  ///< per node: its number in the host's mesh, the same for both surfaces
  VectorXd thickness;           ///< per facet: of the element behind it [mm]; empty: not known

  NodeFlags joined;  ///< per node: whether both surfaces have it, without self-contact; empty: none

  bool may_meet_itself() const { return node_ids.count() > 0; }
  /// Whether both surfaces share a node: it cannot open and has no ambient values.
  bool is_joined(Index node) const { return joined.count() > 0 && joined[node]; }
};

/// Finds the nodes that both surfaces have, given the numbers of their nodes in the host's mesh: SurfaceMesh::joined.
void find_joined_nodes(PerSide<SurfaceMesh>& meshes, const PerSide<std::vector<int>>& numbers);

/// The current state of a surface: one column or row per node.
struct SurfaceFields {
  Matrix3Xd position;  ///< current positions, shape (3, nodes) [mm]
  MatrixXd scalar;     ///< scalar fields, shape (nodes, fields): p~ [MPa] and c~ [mM] in the order of Effects; last the
                       ///< p~ that friction alone reads, if any (Effects::nodal_fields)

  std::size_t memory() const;  ///< [bytes]
};

/// Positions, or positions and fields, of both surfaces as a pass sees them.
using FacingPositions = Facing<Matrix3Xd>;
using FacingFields = Facing<SurfaceFields>;
inline FacingPositions positions(const FacingFields& fields) {
  return {fields.primary.position, fields.secondary.position};
}

/// Whether any of a facet's nodes is among those given.
inline bool any_node(const Facet& facet, const NodeFlags& given) {
  return std::any_of(facet.begin(), facet.end(), [&](int node) { return given[node]; });
}

/// INT psi_a da over one facet, shape (n) [mm^2].
FacetVector areas_of_nodes(const Facet& facet, const Matrix3Xd& position);

/// INT psi_a da over all facets around each node [mm^2].
VectorXd nodal_areas(const SurfaceMesh& mesh, const Matrix3Xd& position);

/// The longest distance of neighbouring corners of a facet [length].
double longest_edge(const Facet& facet, const Matrix3Xd& position);

/// Half the diagonal of the box around all nodes [length].
double half_diagonal(const Matrix3Xd& position);

}  // namespace mixture_contact
