#include "enforcement/penalty_method.h"

#include <utility>

namespace mixture_contact {
namespace {

LoadBlock flux_tangent(const PassNodes& at, int field, Index node, const NodeLinearisation& linear,
                       const NodalLoads& loads, double dt) {
  FluxLaw law = at.laws.scalar(field).flux(loads, node, at.laws.enforcing(field, node));
  // If no other field drives the flux, its variation is proportional to that of the field's jump.
  const double per_jump = law.d_jump[field] > 0 ? law.d_jump[field] : 1.0;
  law.d_jump /= per_jump;
  law.d_own /= per_jump;
  Patch columns = flux_columns(at, linear.patch, field);
  VectorXd row = flux_row(law, node, linear, columns, at.space.symmetric());
  return {{static_cast<int>(node), field, std::move(columns)},
          linear.patch.of_field(field, false),
          linear.jumps[position_in(linear.patch.fields, field)].weights,
          std::move(row),
          dt * per_jump * loads.flux_area(field, node)};
}

}  // namespace

NodalLoads PenaltyMethod::predicted_loads(const PassNodes& at, const LinearisationPoint& point,
                                          const FacingFields& fields) const {
  NodalLoads loads = point.predicted_averages(at.space.slips(), fields);
  load(at.laws, loads);
  return loads;
}

void PenaltyMethod::add_traction_tangent(const PassNodes& at, Index node, const NodeLinearisation& linear,
                                         const NodalLoads& /*loads*/, ScopedTimer& /*laps*/,
                                         NodeTangent& tangent) const {
  const double penalty = at.laws.traction_penalty(node);
  if (has_load_blocks() && !at.space.symmetric()) {
    const Patch rows = linear.patch.of_displacements();
    tangent.loads.push_back(
        {{static_cast<int>(node), std::nullopt, rows}, rows, linear.traction_work, linear.gap_variation, penalty});
    return;
  }
  const VectorXd work = penalty * linear.traction_work;
  tangent.blocks.push_back(traction_block(at.space, linear.patch, work * linear.gap_variation.transpose()));
}

NodeTangent PenaltyMethod::node_tangent(const PassNodes& at, Index node, const NodeLinearisation& linear,
                                        const NodalLoads& loads, const VectorXd& /*weights*/, double dt) const {
  NodeTangent tangent;
  ScopedTimer laps(at.space.effect_times(), at.effects().scalar_fields());
  if (linear.patch.displacements) {
    add_traction_tangent(at, node, linear, loads, laps, tangent);
    laps.traction();
  }
  for (Index k = 0; k < linear.patch.fields.count(); ++k) {
    const int field = linear.patch.fields[k];
    if (!loads.exchanges(field, node)) continue;
    tangent.loads.push_back(flux_tangent(at, field, node, linear, loads, dt));
    laps.field(field);
  }
  return tangent;
}

}  // namespace mixture_contact
