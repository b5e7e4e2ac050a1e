/// The laws by which a tie breaks, and the damage of tied nodes.
#pragma once

#include "conditions/cohesive.h"
#include "conditions/strength.h"

#include <variant>

namespace mixture_contact {

/// A tie that never breaks.
struct Unbreakable {};

using BreakingLaw = std::variant<Unbreakable, Brittle, Cohesive>;

inline bool may_break(const BreakingLaw& law) { return !std::holds_alternative<Unbreakable>(law); }

/// The damage of the tied nodes. All vectors are empty if the tie cannot break.
struct DamageState {
  VectorXd damage;     ///< damage d per tied node: 0 intact, 1 broken permanently [-]
  VectorXd energy;     ///< energy dissipated by damage, per area [mJ/mm^2]
  VectorXd viscous;    ///< energy dissipated by viscosity, per area [mJ/mm^2]
  VectorXd opening;    ///< opening lambda of cohesive bonds at the last accepted solution [mm]
  VectorXd broken_at;  ///< time at which the node broke [s]; negative for a node that has not broken

  DamageState() = default;
  explicit DamageState(Index nodes)
      : damage(VectorXd::Zero(nodes)),
        energy(VectorXd::Zero(nodes)),
        viscous(VectorXd::Zero(nodes)),
        opening(VectorXd::Zero(nodes)),
        broken_at(VectorXd::Constant(nodes, -1.0)) {}

  bool is_broken(Index n) const { return damage.size() > 0 && damage[n] >= 1; }
};

}  // namespace mixture_contact
