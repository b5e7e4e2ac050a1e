/// Damage of a tie at a solution, and its remaining joined nodes.
#pragma once

#include "tie/tie.h"

namespace mixture_contact {

/// The damage that a solution leaves, at a time [s]. Brittle bonds break where their load exceeds the strength;
/// cohesive ones have softened. The stored energy of a bond that breaks at once counts as dissipated.
DamageState damage_after(const Tie& tie, const PerSide<SurfaceFields>& fields, double time);

/// Sets the damage of a tie. Broken nodes lose their multipliers; the equation of an unknown multiplier sets it to
/// zero.
void take_damage(Tie& tie, DamageState damage);

/// Number of broken nodes.
Index broken_nodes(const Tie& tie);

/// Nodes of both surfaces that are not free to part: all but the primary nodes that have broken, and the secondary ones
/// that these alone were tied to.
PerSide<NodeFlags> joined_nodes(const Tie& tie);

}  // namespace mixture_contact
