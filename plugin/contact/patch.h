/// The nodes and fields that a local residual or tangent is about.
#pragma once

#include "local_layout.h"

#include <optional>
#include <vector>

namespace mixture_contact {

/// Nodes of both surfaces, by their indices within the surface the pass integrates over (primary) and the other
/// (secondary), and the exchanged fields, as indices into Effects' order, with the layout of local vectors over them;
/// and the multipliers of a node, where they are unknowns.
struct Patch {
  std::vector<int> primary;
  std::vector<int> secondary;
  std::vector<int> fields;
  std::optional<int> multiplier_node = std::nullopt;  ///< the primary node whose multipliers are unknowns of the patch

  LocalLayout layout() const {
    return {static_cast<Index>(primary.size()), static_cast<Index>(secondary.size()), static_cast<Index>(fields.size()),
            multiplier_node.has_value()};
  }
};

}  // namespace mixture_contact
