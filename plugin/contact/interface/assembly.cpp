/// Residual (2.5), tangent (2.6) and matrix profile: a part of ContactPass.
#include "base/parallel.h"
#include "interface/pass.h"

namespace mixture_contact {

void ContactPass::residual(const SurfaceFields& primary, const SurfaceFields& secondary, double dt,
                           const std::function<void(const Patch&, const VectorXd&)>& add) const {
  const NodalLoads loads = nodal_loads(primary, secondary);
  if (frozen_) {
    const std::vector<NodeLinearisation>& nodes = frozen_->nodes;
    const auto of_node = [&](std::size_t node) {
      return frozen_residual(static_cast<Index>(node), nodes[node], loads, dt);
    };
    in_order(nodes.size(), of_node, [&](std::size_t node, const VectorXd& sum) {
      if (sum.size() > 0) add(nodes[node].patch, sum);
    });
  } else {
    pair_residuals(loads, primary, secondary, dt, add);
  }
  if (!has_unknown_multipliers()) return;
  const VectorXd weights = present_multiplier_weights(loads, primary.position);
  for (Index node = 0; node < primary_.nodes; ++node) {
    add(node_patch(node, {}), multiplier_residual(node, loads, weights, dt));
  }
}

void ContactPass::pair_residuals(const NodalLoads& loads, const SurfaceFields& primary, const SurfaceFields& secondary,
                                 double dt, const std::function<void(const Patch&, const VectorXd&)>& add) const {
  const auto residual_of = [&](std::size_t index) {
    const FacetPair& pair = pairs_[index];
    VectorXd sum;
    if (!carries_load(pair, loads.in_contact)) return sum;
    const LocalLayout layout = facet_patch(pair).layout();
    sum.setZero(layout.size());
    for (const IntegrationPoint& place : pair.points) {
      const PointContact point = contact(pair, place, loads, primary, secondary, dt);
      sum += point_residual(point.kinematics, point.loads, layout);
    }
    return sum;
  };
  in_order(pairs_.size(), residual_of, [&](std::size_t index, const VectorXd& sum) {
    if (sum.size() > 0) add(facet_patch(pairs_[index]), sum);
  });
}

// ------------------------------------------------------------ tangent

void ContactPass::tangent(const SurfaceFields& primary, const SurfaceFields& secondary, double dt,
                          const std::function<void(const TangentBlock&)>& add) const {
  const auto add_all = [&](std::size_t /*index*/, const std::vector<TangentBlock>& blocks) {
    for (const TangentBlock& block : blocks) add(block);
  };
  NodalLoads loads = nodal_loads(primary, secondary);
  std::vector<NodeLinearisation> present;
  if (!held_ && !frozen_) present = linearise(loads, primary, secondary);
  const std::vector<NodeLinearisation>& nodes = frozen_ ? frozen_->nodes : held_ ? held_->nodes : present;
  const VectorXd weights = present_multiplier_weights(loads, primary.position);
  const auto of_node = [&](std::size_t node) {
    const auto index = static_cast<Index>(node);
    if (nodes[node].empty()) return std::vector<TangentBlock>();
    return has_unknown_multipliers() ? multiplier_tangent(index, nodes[node], loads, weights, dt)
                                     : law_tangent(index, nodes[node], loads, dt);
  };
  in_order(nodes.size(), of_node, add_all);
  if (frozen_) return;
  if (held_) {
    loads.traction = held_->geometric_traction;
    loads.flux = held_->geometric_flux;
  }
  const auto of_pair = [&](std::size_t index) {
    return geometric_tangent(pairs_[index], loads, primary, secondary, dt);
  };
  in_order(pairs_.size(), of_pair, add_all);
}

TangentBlock ContactPass::traction_block(const Patch& patch, MatrixXd values) const {
  if (settings_.symmetric) values = 0.5 * (values + values.transpose()).eval();
  return {patch.of_displacements(), patch.of_displacements(), std::move(values)};
}

VectorXd ContactPass::jump_row(const NodeLinearisation::Jump& jump, const Patch& columns) {
  const LocalLayout layout = columns.layout();
  const LocalLayout displacements = columns.of_displacements().layout();
  VectorXd row = VectorXd::Zero(layout.size());
  for (Index n = 0; n < layout.nodes(); ++n) {
    row[layout.scalar(n, 0)] = jump.weights[n];
    if (!layout.has_displacements()) continue;
    row.segment<3>(layout.displacement(n, 0)) = jump.drift.segment<3>(displacements.displacement(n, 0));
  }
  return row;
}

std::vector<TangentBlock> ContactPass::law_tangent(Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                                                   double dt) const {
  // The residual holds t_a traction_work + dt phi_a A_a weights; the variation of the works is the geometric part.
  std::vector<TangentBlock> blocks;
  Laps laps(effect_times_, effects_.scalar_fields());
  if (effects_.traction) {
    const double penalty = traction_penalty(node);
    blocks.push_back(traction_block(linear.patch, penalty * linear.traction_work * linear.gap_variation.transpose()));
    laps.traction();
  }
  for (std::size_t k = 0; k < linear.patch.fields.size(); ++k) {
    const int field = linear.patch.fields[k];
    if (!passes(loads, field, node)) continue;
    const double factor = dt * flux_penalty(field, node) * loads.flux_area(field, node);
    const Patch columns = field_columns(linear.patch, field);
    blocks.push_back({linear.patch.of_field(field, false), columns,
                      factor * linear.jumps[k].weights * jump_row(linear.jumps[k], columns).transpose()});
    laps.field(field);
  }
  return blocks;
}

std::vector<TangentBlock> ContactPass::geometric_tangent(const FacetPair& pair, const NodalLoads& loads,
                                                         const SurfaceFields& primary, const SurfaceFields& secondary,
                                                         double dt) const {
  std::vector<TangentBlock> blocks;
  if (!carries_load(pair, loads.in_contact)) return blocks;
  const Patch patch = facet_patch(pair);
  const LocalLayout displacements = patch.of_displacements().layout();
  MatrixXd traction = MatrixXd::Zero(displacements.size(), displacements.size());
  if (!settings_.symmetric) {  // what is left of the fluxes' part depends on displacements alone
    for (const int field : patch.fields) {
      const Patch columns = field_columns(patch, field);
      blocks.push_back(
          {patch.of_field(field, false), columns, MatrixXd::Zero(displacements.nodes(), columns.layout().size())});
    }
  }
  Laps laps(effect_times_, effects_.scalar_fields());
  const std::vector<VaryingPoint> points = varying_points(pair, loads, primary, secondary, dt);
  laps.shared();
  for (const auto& [point, vary] : points) {
    traction += traction_tangent(point.kinematics, vary, point.loads, displacements);
  }
  laps.traction();
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const auto index = static_cast<Index>(k);
    for (const auto& [point, vary] : points) {
      blocks[k].values += flux_tangent(point.kinematics, vary, point.loads, index, point.values.col(index),
                                       blocks[k].columns.layout());
    }
    laps.field(patch.fields[k]);
  }
  blocks.push_back(traction_block(patch, std::move(traction)));
  return blocks;
}

void ContactPass::for_each_coupling(const Matrix3Xd& x1, const Matrix3Xd& x2,
                                    const std::function<void(const Patch&)>& use) const {
  const auto use_effects = [&](const Patch& patch) {
    // A field whose flux depends on the displacements couples these, too.
    if (effects_.traction && (patch.fields.empty() || settings_.symmetric)) use(patch.of_displacements());
    for (const int field : patch.fields) use(field_columns(patch, field));
  };
  if (frozen_) {
    for (const NodeLinearisation& node : frozen_->nodes) use_effects(node.patch);
    return;
  }
  // A node's patch holds the facet pairs of all points that its loads act at.
  const auto around = pairs_around_nodes(held_ ? held_->loads.in_contact : natural_status(x1, x2));
  const auto patch_of = [&](std::size_t node) {
    const bool absent = around[node].empty() && !has_unknown_multipliers();
    return absent ? Patch() : node_patch(static_cast<Index>(node), around[node]);
  };
  in_order(around.size(), patch_of, [&](std::size_t node, const Patch& patch) {
    if (!around[node].empty() || has_unknown_multipliers()) use_effects(patch);
  });
}

}  // namespace mixture_contact
