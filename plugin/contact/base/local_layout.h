/// The layout of a local vector: which entry is which node's displacement, pressure or concentration.
#pragma once

#include "base/types.h"

namespace mixture_contact {

/// Layout of the unknowns of a pair of facets: node by node (primary nodes first), each with its three displacements,
/// if any, and then its exchanged scalar fields. No other place in the code knows the order.
///
/// Multipliers of one node, where they are unknowns, follow as one more block: that of the traction in place of the
/// first displacement, those of the fluxes in place of the fields. The places of the other two displacements are void.
class LocalLayout {
 public:
  LocalLayout(Index primary_nodes, Index secondary_nodes, Index scalar_fields, bool multipliers = false,
              bool displacements = true)
      : primary_nodes_(primary_nodes),
        secondary_nodes_(secondary_nodes),
        scalar_fields_(scalar_fields),
        multipliers_(multipliers),
        displacements_(displacements ? 3 : 0) {}

  Index primary_nodes() const { return primary_nodes_; }
  Index nodes() const { return primary_nodes_ + secondary_nodes_; }
  Index scalar_fields() const { return scalar_fields_; }
  Index per_node() const { return displacements_ + scalar_fields_; }
  bool has_displacements() const { return displacements_ > 0; }
  bool has_multipliers() const { return multipliers_; }
  /// Nodes, and the block of multipliers.
  Index blocks() const { return nodes() + (multipliers_ ? 1 : 0); }
  Index size() const { return blocks() * per_node(); }

  /// Entry of component i (0, 1, 2) of a node's displacement, if there are any.
  Index displacement(Index node, Index i) const { return node * per_node() + i; }
  /// Entry of a node's scalar field k, in the order of Effects.
  Index scalar(Index node, Index k) const { return node * per_node() + displacements_ + k; }
  Index traction_multiplier() const { return displacement(nodes(), 0); }
  Index flux_multiplier(Index k) const { return scalar(nodes(), k); }

 private:
  Index primary_nodes_;
  Index secondary_nodes_;
  Index scalar_fields_;
  bool multipliers_;
  Index displacements_;  ///< per node
};

/// Order of all multipliers of a surface, where they are unknowns: node by node, traction first, if any, then the
/// fields'.
class MultiplierLayout {
 public:
  MultiplierLayout(Index nodes, Index scalar_fields, bool tractions = true)
      : nodes_(nodes), scalar_fields_(scalar_fields), tractions_(tractions ? 1 : 0) {}

  Index size() const { return nodes_ * per_node(); }
  Index traction(Index node) const { return node * per_node(); }
  Index flux(Index node, Index k) const { return node * per_node() + tractions_ + k; }

 private:
  Index per_node() const { return tractions_ + scalar_fields_; }

  Index nodes_;
  Index scalar_fields_;
  Index tractions_;  ///< per node
};

}  // namespace mixture_contact
