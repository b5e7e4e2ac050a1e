#include "enforcement/penalty_method.h"

namespace mixture_contact {

NodalLoads PenaltyMethod::predicted_loads(const LinearisationPoint& point, const FacingFields& fields) const {
  NodalLoads loads = point.predicted_averages(fields);
  load(loads);
  return loads;
}

std::vector<TangentBlock> PenaltyMethod::node_tangent(Index node, const NodeLinearisation& linear,
                                                      const NodalLoads& loads, const VectorXd& /*weights*/,
                                                      double dt) const {
  std::vector<TangentBlock> blocks;
  ScopedTimer laps(space().effect_times(), effects().scalar_fields());
  if (effects().traction) {
    const double penalty = laws().traction_penalty(node);
    blocks.push_back(
        traction_block(space(), linear.patch, penalty * linear.traction_work * linear.gap_variation.transpose()));
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
