#include "enforcement/penalty_method.h"

#include <utility>

namespace mixture_contact {
namespace {

/// Adds the rows of the nodes that friction works at, `change` times its work at each.
void add_work(const VectorXd& work, const Matrix3Xd& change, MatrixXd& tangent) {
  for (Index n = 0; n < work.size(); ++n) tangent.middleRows<3>(3 * n) += work[n] * change;
}

}  // namespace

NodalLoads PenaltyMethod::predicted_loads(const LinearisationPoint& point, const FacingFields& fields) const {
  NodalLoads loads = point.predicted_averages(fields);
  load(loads);
  return loads;
}

void PenaltyMethod::add_friction(Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                                 MatrixXd& tangent, std::vector<TangentBlock>& blocks) const {
  if (!loads.in_contact[node]) return;
  if (!loads.slips[node]) return add_work(linear.friction.work, linear.friction.trial_variation, tangent);
  const FrictionTraction law = friction_law(loads, node);
  const FrictionBound bound = laws().friction_bound(loads, node);
  const NodeLinearisation::Friction& friction = linear.friction;
  Eigen::RowVectorXd d_bound = bound.d_traction * laws().traction_penalty(node) * linear.gap_variation.transpose();
  if (friction.has_fluid()) d_bound += bound.d_pressure * friction.pressure_variation.transpose();
  add_work(friction.work, law.d_trial.lazyProduct(friction.trial_variation) + law.d_bound.lazyProduct(d_bound),
           tangent);
  if (!friction.has_fluid() || bound.d_pressure == 0 || space().symmetric()) return;
  const Patch columns = linear.patch.of_field(friction.pressure_field, false);
  MatrixXd by_pressure(tangent.rows(), friction.work.size());
  const Vector3d per_pressure = bound.d_pressure * law.d_bound;
  for (Index n = 0; n < friction.work.size(); ++n)
    by_pressure.middleRows<3>(3 * n) = friction.work[n] * per_pressure * friction.pressure_weights.transpose();
  blocks.push_back({linear.patch.of_displacements(), columns, std::move(by_pressure)});
}

std::vector<TangentBlock> PenaltyMethod::node_tangent(Index node, const NodeLinearisation& linear,
                                                      const NodalLoads& loads, const VectorXd& /*weights*/,
                                                      double dt) const {
  std::vector<TangentBlock> blocks;
  ScopedTimer laps(space().effect_times(), effects().scalar_fields());
  if (effects().traction) {
    const double penalty = laws().traction_penalty(node);
    MatrixXd tangent = penalty * linear.traction_work * linear.gap_variation.transpose();
    laps.traction();
    if (!linear.friction.empty()) add_friction(node, linear, loads, tangent, blocks);
    laps.friction();
    blocks.push_back(traction_block(space(), linear.patch, std::move(tangent)));
    laps.traction();
  }
  for (Index k = 0; k < linear.patch.fields.count(); ++k) {
    const int field = linear.patch.fields[k];
    if (!loads.exchanges(field, node)) continue;
    const double factor = dt * laws().flux_penalty(field, node) * loads.flux_area(field, node);
    const Patch columns = space().columns_of(linear.patch, field);
    blocks.push_back({linear.patch.of_field(field, false), columns,
                      factor * linear.jumps[k].weights * jump_row(linear.jumps[k], columns).transpose()});
    laps.field(field);
  }
  return blocks;
}

}  // namespace mixture_contact
