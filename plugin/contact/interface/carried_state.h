/// The state of a contact whose surfaces lose or gain nodes in a run: an eroded element loses its facets, and facets of
/// its neighbours may replace them.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// The numbers of the nodes of both surfaces in the host's mesh.
using NodeNumbers = PerSide<IndexedVector<int>>;

/// A state with the numbers of its nodes.
struct NumberedState {
  NodeNumbers nodes;
  ContactInterface::State state;
};

/// The state of a contact after a change of its nodes. Nodes that remain keep their multipliers, loads, and reference
/// positions of slips. New nodes have the initial state in `fresh`, the state of a new contact with these nodes; their
/// slips are measured from their present `position`. Penetration-check nodes and load carriers are found again. If the
/// exchanged fields differ, the result is `fresh` without anything from `before`.
ContactInterface::State carried_over(const NumberedState& before, NumberedState fresh,
                                     const PerSide<Matrix3Xd>& position);

}  // namespace mixture_contact
