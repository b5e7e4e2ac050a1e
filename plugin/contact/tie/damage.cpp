#include "tie/damage.h"

#include "tie/gap_vector.h"

#include <utility>

namespace mixture_contact {
namespace {

/// The damage of a node at a solution, and the energy that it dissipates on the way from its accepted damage.
struct Advance {
  double damage = 0;
  Dissipated energy;
  double opening = 0;  ///< opening lambda [mm]
};

Advance advance(const Unbreakable& /*law*/, const Tie& /*tie*/, Index /*n*/, const TieLoads& /*loads*/,
                const Vector3d& /*normal*/) {
  return {0, {}, 0};
}

Advance advance(const Brittle& law, const Tie& /*tie*/, Index n, const TieLoads& loads, const Vector3d& normal) {
  const Vector3d traction = loads.traction.col(n);
  if (!exceeds(law, traction, normal)) return {0, {}, 0};
  return {1, {0.5 * traction.dot(loads.gap.col(n)), 0}, 0};
}

Advance advance(const Cohesive& law, const Tie& tie, Index n, const TieLoads& loads, const Vector3d& normal) {
  const double before = tie.state().damage.damage[n];
  const double after = loads.damage[n];
  const Vector3d gap = loads.gap.col(n);
  const double opening = opening_size(gap, normal);
  if (!(after > before)) return {before, {}, opening};
  const double from = tie.state().damage.opening[n];
  return {after, dissipated(law, tie.traction_penalty(n), before, after, from, gap, normal), opening};
}

}  // namespace

DamageState damage_after(const Tie& tie, const PerSide<SurfaceFields>& fields, double time) {
  DamageState next = tie.state().damage;
  const TieLoads loads = tie.loads(fields);
  const FacingPositions x{fields[Side::primary].position, fields[Side::secondary].position};
  for (Index n = 0; n < next.damage.size(); ++n) {
    if (next.is_broken(n)) continue;
    const Vector3d normal = normal_of(tie.nodes()[n], x);
    const Advance step = std::visit([&](const auto& law) { return advance(law, tie, n, loads, normal); },
                                    tie.breaking());
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
