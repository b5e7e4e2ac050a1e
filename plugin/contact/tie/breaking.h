/// The ways in which a tie breaks, with a type for each, and the damage of its nodes.
#pragma once

#include "conditions/cohesive.h"
#include "conditions/strength.h"

#include <variant>

namespace mixture_contact {

/// A tie that lasts for ever.
struct Unbreakable {};

using BreakingLaw = std::variant<Unbreakable, Brittle, Cohesive>;

inline bool may_break(const BreakingLaw& law) { return !std::holds_alternative<Unbreakable>(law); }

/// The damage of tied nodes; empty where a tie cannot break.
struct DamageState {
  VectorXd damage;     ///< d per tied node: 0 whole, 1 broken for ever [-]
  VectorXd energy;     ///< dissipated by damage [mJ/mm^2]
  VectorXd viscous;    ///< dissipated by viscosity [mJ/mm^2]
  VectorXd opening;    ///< lambda at the last solution [mm]; of cohesive bonds
  VectorXd broken_at;  ///< time at which the node broke [s]; negative while it has not

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
