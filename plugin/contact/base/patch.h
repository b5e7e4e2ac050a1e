/// The nodes and fields of a local residual or tangent.
#pragma once

#include "base/indexed_vector.h"
#include "base/local_layout.h"

#include <optional>

namespace mixture_contact {

/// The nodes and fields whose unknowns belong to a local vector or matrix, and their layout.
struct Patch {
  /// Indices of nodes of the primary surface, over which the pass integrates.
  IndexedVector<int> primary;
  /// Indices of nodes of the secondary surface.
  IndexedVector<int> secondary;
  /// Exchanged fields, as indices in the order of Effects.
  IndexedVector<int> fields;
  /// Primary node whose multipliers are unknowns of the patch, if any.
  std::optional<int> multiplier_node = std::nullopt;
  bool displacements = true;  ///< true if the displacements of the nodes are unknowns of the patch

  /// The layout of local vectors of the patch.
  LocalLayout layout() const {
    return {primary.count(), secondary.count(), fields.count(), multiplier_node.has_value(), displacements};
  }

  /// The n-th node of the layout, as an index on its surface.
  int node(Index n) const { return n < primary.count() ? primary[n] : secondary[n - primary.count()]; }

  /// The layout of of_displacements(); it does not make that patch.
  LocalLayout displacement_layout() const {
    return {primary.count(), secondary.count(), 0, multiplier_node.has_value(), true};
  }
  /// The layout of of_field(); it does not make that patch.
  LocalLayout field_layout(bool with_displacements) const {
    return {primary.count(), secondary.count(), 1, multiplier_node.has_value(), with_displacements};
  }

  /// The patch of all nodes with their displacements and without fields.
  Patch of_displacements() const { return {primary, secondary, {}, multiplier_node, true}; }
  /// The patch of the n-th node of the layout, with the multipliers.
  Patch of_node(Index n) const {
    const bool is_primary = n < primary.count();
    return {is_primary ? IndexedVector<int>{node(n)} : IndexedVector<int>(),
            is_primary ? IndexedVector<int>() : IndexedVector<int>{node(n)}, fields, multiplier_node, displacements};
  }
  /// The patch of the multipliers without nodes.
  Patch of_multipliers() const { return {{}, {}, fields, multiplier_node, displacements}; }
  /// The patch of all nodes with one field (index in the order of Effects), with or without displacements.
  Patch of_field(int field, bool with_displacements) const {
    return {primary, secondary, {field}, multiplier_node, with_displacements};
  }
};

/// A part of a tangent: the derivatives of the equations of one effect with respect to the unknowns on which they
/// depend.
struct TangentBlock {
  Patch rows;       ///< for the traction, the displacements; for a flux, its field
  Patch columns;    ///< for the traction, the displacements; for a flux, the displacements and its field
  MatrixXd values;  ///< shape (rows.layout().size(), columns.layout().size())
};

/// A nodal load, the traction or the flux of a field, as a scalar. The unknowns in `columns` determine it, and it acts
/// on some of their nodes.
struct LoadPlace {
  int node = 0;              ///< node of the surface over which the pass integrates
  std::optional<int> field;  ///< field of the flux; none for the traction
  Patch columns;             ///< unknowns on which the load depends; they include those of the nodes on which it acts
};

/// The rank-one part of a tangent that a load adds because it depends on the unknowns: work factor variation^T.
struct LoadBlock {
  LoadPlace place;
  Patch rows;     ///< equations in which the load acts, as TangentBlock::rows
  VectorXd work;  ///< virtual work of a unit load, size rows.layout().size()
  /// Derivatives of the gap or jump with respect to the unknowns in place.columns, size place.columns.layout().size().
  VectorXd variation;
  double factor = 0;  ///< derivative of the load with respect to the gap or jump

  /// The tangent block work factor variation^T.
  TangentBlock product() const { return {rows, place.columns, (factor * work) * variation.transpose()}; }
};

}  // namespace mixture_contact
