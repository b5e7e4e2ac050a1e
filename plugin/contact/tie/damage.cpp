#include "tie/damage.h"

#include "tie/gap_vector.h"

#include <utility>
#include <variant>

namespace mixture_contact {
namespace {

/// The damage of a node at a solution, and the energy that it dissipates on the way from its accepted damage.
struct Advance {
  double damage = 0;
  Dissipated energy;
  double opening = 0;  ///< opening lambda [mm]
};

/// A tied node at a state.
struct Bond {
  const Tie& tie;
  const TieLoads& loads;
  Index node;  ///< index of the tied node
  FacingPositions x;
  /// Traction that the strength of a brittle bond limits [MPa], see judged_tractions().
  Vector3d traction;
  double error = 0;  ///< largest error of the traction [MPa]

  /// The traction that is smaller by its error.
  Vector3d certain_traction() const {
    const double size = traction.norm();
    return size > error ? Vector3d((1 - error / size) * traction) : Vector3d::Zero();
  }
};

/// The mean tractions around the tied nodes of a brittle tie, which are the forces that it exerts with psi_a per area,
/// one column per tied node [MPa]. The tractions t_a of TieLoads are coefficients of the acting traction, the sum of
/// t_a psi_a, and exceed its mean where it varies from node to node. Other laws need no mean: their tractions are 0.
Matrix3Xd judged_tractions(const Tie& tie, const TieLoads& loads) {
  Matrix3Xd means = Matrix3Xd::Zero(3, tie.nodes().count());
  if (!std::holds_alternative<Brittle>(tie.breaking())) return means;
  Matrix3Xd coefficients = Matrix3Xd::Zero(3, tie.mesh()[Side::primary].nodes);
  for (Index n = 0; n < tie.nodes().count(); ++n) coefficients.col(tie.nodes()[n].node) = loads.traction.col(n);
  for (Index n = 0; n < tie.nodes().count(); ++n) {
    const TiedNode& tied = tie.nodes()[n];
    for (Index b = 0; b < tied.primary.count(); ++b)
      means.col(n) += tied.primary_shares[b] * coefficients.col(tied.primary[b]);
  }
  return means;
}

Advance advance(const Unbreakable& /*law*/, const Bond& /*bond*/) { return {0, {}, 0}; }

Advance advance(const Brittle& law, const Bond& bond) {
  const Vector3d normal = faced_normal(bond.tie.nodes()[bond.node], bond.x);
  if (!exceeds(law, bond.certain_traction(), normal)) return {0, {}, 0};
  return {1, {0.5 * bond.loads.traction.col(bond.node).dot(bond.loads.gap.col(bond.node)), 0}, 0};
}

Advance advance(const Cohesive& law, const Bond& bond) {
  const DamageState& state = bond.tie.state().damage;
  const double before = state.damage[bond.node];
  const double after = bond.loads.damage[bond.node];
  const Vector3d gap = bond.loads.gap.col(bond.node);
  const Vector3d normal = normal_of(bond.tie.nodes()[bond.node], bond.x);
  const double opening = opening_size(gap, normal);
  if (!(after > before)) return {before, {}, opening};
  const double penalty = bond.tie.traction_penalty(bond.node);
  return {after, dissipated(law, penalty, before, after, state.opening[bond.node], gap, normal), opening};
}

}  // namespace

DamageState damage_after(const Tie& tie, const PerSide<SurfaceFields>& fields, double time, double error) {
  DamageState next = tie.state().damage;
  const TieLoads loads = tie.loads(fields);
  const Matrix3Xd tractions = judged_tractions(tie, loads);
  const FacingPositions x{fields[Side::primary].position, fields[Side::secondary].position};
  for (Index n = 0; n < next.damage.size(); ++n) {
    if (next.is_broken(n)) continue;
    const Bond bond{tie, loads, n, x, tractions.col(n), error};
    const Advance step = std::visit([&](const auto& law) { return advance(law, bond); }, tie.breaking());
    next.damage[n] = step.damage;
    next.energy[n] += step.energy.by_damage;
    next.viscous[n] += step.energy.by_viscosity;
    next.opening[n] = step.opening;
    if (next.is_broken(n)) next.broken_at[n] = time;
  }
  return next;
}

void take_damage(Tie& tie, DamageState damage) {
  TieState state = tie.state();
  state.damage = std::move(damage);
  for (Index n = 0; n < tie.nodes().count() && !tie.has_unknown_multipliers(); ++n) {
    if (!state.damage.is_broken(n)) continue;
    state.traction.col(n).setZero();
    state.flux.col(n).setZero();
  }
  tie.restore(std::move(state));
}

Index broken_nodes(const Tie& tie) {
  Index count = 0;
  for (Index n = 0; n < tie.nodes().count(); ++n) count += tie.state().damage.is_broken(n) ? 1 : 0;
  return count;
}

PerSide<NodeFlags> joined_nodes(const Tie& tie) {
  PerSide<NodeFlags> joined;
  for (const Side side : both_sides) joined[side] = NodeFlags(tie.mesh()[side].nodes, true);
  for (Index n = 0; n < tie.nodes().count(); ++n) {
    if (!tie.state().damage.is_broken(n)) continue;
    joined[Side::primary][tie.nodes()[n].node] = false;
    for (const int node : tie.nodes()[n].secondary) joined[Side::secondary][node] = false;
  }
  for (Index n = 0; n < tie.nodes().count(); ++n) {
    if (tie.state().damage.is_broken(n)) continue;
    for (const int node : tie.nodes()[n].secondary) joined[Side::secondary][node] = true;
  }
  return joined;
}

}  // namespace mixture_contact
