/// Output of a tie: balances, and values at the nodes of both surfaces.
#pragma once

#include "interface/output.h"
#include "tie/tie.h"

namespace mixture_contact {

/// The output of a tie. Gap and pressure are the normal components of gap vector and traction, as for sliding contact;
/// a tensile traction is a negative pressure. The tangential components are output as slip and friction traction. Nodes
/// that are not tied, or are broken, have zeros.
///
/// `damage`: the damage of the solution at this state.
InterfaceOutput output(const Tie& tie, const PerSide<SurfaceFields>& fields, const DamageState& damage);
/// The output of a tie with its accepted damage.
inline InterfaceOutput output(const Tie& tie, const PerSide<SurfaceFields>& fields) {
  return output(tie, fields, tie.state().damage);
}

}  // namespace mixture_contact
