/// Output of a tie: balances, and values at the nodes of both surfaces.
#pragma once

#include "interface/output.h"
#include "tie/tie.h"

namespace mixture_contact {

/// Normal parts of gap and traction are those of a contact, tension being a negative pressure; tangential parts stand
/// where friction and slip do. Nodes that are not tied, or not any more, have zeros. `damage`: that of a solution at
/// this state.
InterfaceOutput output(const Tie& tie, const PerSide<SurfaceFields>& fields, const DamageState& damage);
inline InterfaceOutput output(const Tie& tie, const PerSide<SurfaceFields>& fields) {
  return output(tie, fields, tie.state().damage);
}

}  // namespace mixture_contact
