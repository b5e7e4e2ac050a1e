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

/// The state that a contact with other nodes goes on with. Nodes that were there before keep their multipliers and
/// loads, and the positions that their slips are measured from; others have what `fresh`, a contact that has just been
/// made for the new nodes, begins with, and slips from their present `position`. Penetration-check nodes and load
/// carriers are found again. Nothing is kept if both exchange other fields.
ContactInterface::State carried_over(const NumberedState& before, NumberedState fresh,
                                     const PerSide<Matrix3Xd>& position);

}  // namespace mixture_contact
