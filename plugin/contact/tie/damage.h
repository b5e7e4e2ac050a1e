/// Damage of a tie at an accepted solution, and the nodes that are still joined.
#pragma once

#include "tie/tie.h"

namespace mixture_contact {

/// The damage after an accepted solution at a time [s]. Brittle bonds break if their traction exceeds the strength;
/// cohesive bonds soften. The stored energy of a brittle bond that breaks counts as dissipated. `error`: largest error
/// of the tractions, 0 at a solution; a brittle bond breaks only if it would break with this error [MPa].
DamageState damage_after(const Tie& tie, const PerSide<SurfaceFields>& fields, double time, double error = 0);

/// Sets the damage of a tie. The multipliers of broken nodes become zero; an unknown multiplier of a broken node
/// becomes zero through its own equation.
void take_damage(Tie& tie, DamageState damage);

/// The number of broken nodes.
Index broken_nodes(const Tie& tie);

/// Per surface, true for the nodes that remain joined. Primary nodes that have broken are free, and so are secondary
/// nodes that were tied to broken nodes only. All other nodes count as joined.
PerSide<NodeFlags> joined_nodes(const Tie& tie);

}  // namespace mixture_contact
