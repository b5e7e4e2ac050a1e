/// The layout of a local vector: which entry is which node's displacement, pressure or concentration.
#pragma once

#include "types.h"

namespace mixture_contact {

/// Layout of the unknowns of a pair of facets: node by node (primary nodes first), each with its three displacements,
/// if any, and then its exchanged scalar fields. No other place in the code knows the order.
class LocalLayout {
 public:
  LocalLayout(Index primary_nodes, Index secondary_nodes, Index scalar_fields)
      : primary_nodes_(primary_nodes), secondary_nodes_(secondary_nodes), scalar_fields_(scalar_fields) {}

  Index primary_nodes() const { return primary_nodes_; }
  Index nodes() const { return primary_nodes_ + secondary_nodes_; }
  Index scalar_fields() const { return scalar_fields_; }
  Index per_node() const { return 3 + scalar_fields_; }
  Index size() const { return nodes() * per_node(); }

  /// Entry of component i (0, 1, 2) of a node's displacement.
  Index displacement(Index node, Index i) const { return node * per_node() + i; }
  /// Entry of a node's scalar field k, in the order of Effects.
  Index scalar(Index node, Index k) const { return node * per_node() + 3 + k; }

 private:
  Index primary_nodes_;
  Index secondary_nodes_;
  Index scalar_fields_;
};

}  // namespace mixture_contact
