/// The order of the unknowns in a local vector: displacements, pressures, concentrations and multipliers.
#pragma once

#include "base/effects.h"
#include "base/types.h"

namespace mixture_contact {

/// The order of the unknowns of a pair of facets: node by node (primary nodes first), each with its three
/// displacements, if any, and then its exchanged scalar fields. No other code computes such an index.
///
/// Multipliers of one node, if they are unknowns, follow as one more block: the multiplier of the traction takes the
/// entry of the first displacement, those of the fluxes take the entries of the fields. The entries of the other two
/// displacements are unused.
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
  /// Number of unknowns of a node.
  Index per_node() const { return displacements_ + scalar_fields_; }
  bool has_displacements() const { return displacements_ > 0; }
  bool has_multipliers() const { return multipliers_; }
  /// Number of blocks: the nodes, plus one for multipliers.
  Index blocks() const { return nodes() + (multipliers_ ? 1 : 0); }
  Index size() const { return blocks() * per_node(); }

  /// Entry of component i (0, 1, 2) of a node's displacement; valid if the layout has displacements.
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
  Index displacements_;  ///< displacements per node: 3 or 0
};

/// The order of all multipliers of a surface that are unknowns: node by node, first that of the traction, if any, then
/// those of the fields.
class MultiplierLayout {
 public:
  MultiplierLayout(Index nodes, const Effects& effects)
      : nodes_(nodes), scalar_fields_(effects.scalar_fields()), tractions_(effects.traction ? 1 : 0) {}

  Index size() const { return nodes_ * per_node(); }
  bool has_tractions() const { return tractions_ > 0; }
  Index traction(Index node) const { return node * per_node(); }
  Index flux(Index node, Index k) const { return node * per_node() + tractions_ + k; }

 private:
  Index per_node() const { return tractions_ + scalar_fields_; }

  Index nodes_;
  Index scalar_fields_;
  Index tractions_;  ///< traction multipliers per node: 1 or 0
};

}  // namespace mixture_contact
