/// The nodes and fields that a local residual or tangent is about.
#pragma once

#include "base/indexed_vector.h"
#include "base/local_layout.h"

#include <optional>

namespace mixture_contact {

/// Nodes of both surfaces, by their indices within the surface the pass integrates over (primary) and the other
/// (secondary), and the exchanged fields, as indices into Effects' order, with the layout of local vectors over them;
/// and the multipliers of a node, where they are unknowns.
struct Patch {
  IndexedVector<int> primary;
  IndexedVector<int> secondary;
  IndexedVector<int> fields;
  std::optional<int> multiplier_node = std::nullopt;  ///< the primary node whose multipliers are unknowns of the patch
  bool displacements = true;                          ///< whether the nodes' displacements are among the unknowns

  LocalLayout layout() const {
    return {primary.count(), secondary.count(), fields.count(), multiplier_node.has_value(), displacements};
  }

  /// The n-th node of the layout, by its index within its surface.
  int node(Index n) const { return n < primary.count() ? primary[n] : secondary[n - primary.count()]; }

  /// The layout of local vectors over of_displacements(), without that patch being made.
  LocalLayout displacement_layout() const {
    return {primary.count(), secondary.count(), 0, multiplier_node.has_value(), true};
  }
  /// The layout of local vectors over of_field(), without that patch being made.
  LocalLayout field_layout(bool with_displacements) const {
    return {primary.count(), secondary.count(), 1, multiplier_node.has_value(), with_displacements};
  }

  /// The patch of all nodes with their displacements and without fields.
  Patch of_displacements() const { return {primary, secondary, {}, multiplier_node, true}; }
  /// The n-th node of the layout alone, with the multipliers.
  Patch of_node(Index n) const {
    const bool is_primary = n < primary.count();
    return {is_primary ? IndexedVector<int>{node(n)} : IndexedVector<int>(),
            is_primary ? IndexedVector<int>() : IndexedVector<int>{node(n)}, fields, multiplier_node, displacements};
  }
  /// The multipliers without the nodes.
  Patch of_multipliers() const { return {{}, {}, fields, multiplier_node, displacements}; }
  /// The patch of all nodes with one field, in Effects' order, and with the nodes' displacements or without.
  Patch of_field(int field, bool with_displacements) const {
    return {primary, secondary, {field}, multiplier_node, with_displacements};
  }
};

/// A part of a tangent: the equations of one effect by the unknowns that they depend on.
struct TangentBlock {
  Patch rows;       ///< traction: the displacements; a flux: its field
  Patch columns;    ///< traction: the displacements; a flux: displacements and its field
  MatrixXd values;  ///< shape (rows.layout().size(), columns.layout().size())
};

/// A load at a node, its traction or the flux of a field, as one scalar between the nodes that it acts on and those
/// that it depends on.
struct LoadPlace {
  int node = 0;              ///< of the surface integrated over
  std::optional<int> field;  ///< whose flux it is; none: the traction
  Patch columns;             ///< variables of the load; the nodes that it acts on are among theirs
};

/// The part of a tangent that a load makes as it follows the unknowns, a product of vectors: work factor variation^T.
struct LoadBlock {
  LoadPlace place;
  Patch rows;          ///< as those of a TangentBlock
  VectorXd work;       ///< virtual work of a unit of the load, size rows.layout().size()
  VectorXd variation;  ///< of the unknowns that the load depends on, size place.columns.layout().size()
  double factor = 0;   ///< load per unit of it

  TangentBlock product() const { return {rows, place.columns, (factor * work) * variation.transpose()}; }
};

}  // namespace mixture_contact
