/// The state of a contact whose surfaces lose or gain nodes in a run: an element that erodes takes its facets away, and
/// those of its neighbours may take their place.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// The number of each node of both surfaces in the host's mesh.
using NodeNumbers = PerSide<IndexedVector<int>>;

/// A state, and the nodes that it is the state of.
struct NumberedState {
  NodeNumbers nodes;
  ContactInterface::State state;
};

/// The state of a contact after a change of its nodes. Old nodes keep their multipliers, loads and reference positions
/// of slips. New nodes have the initial state of `fresh`, a new contact of these nodes, and slips from their present
/// `position`. Penetration-check nodes and load carriers are found again. Nothing is kept if both exchange other
/// fields.
ContactInterface::State carried_over(const NumberedState& before, NumberedState fresh,
                                     const PerSide<Matrix3Xd>& position);

}  // namespace mixture_contact
