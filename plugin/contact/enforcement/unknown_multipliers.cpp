#include "enforcement/unknown_multipliers.h"

namespace mixture_contact {
namespace {

/// A node's value; where it is zero (impermeable facets around it), any of the surface's that is not.
double unit_of(const Eigen::Ref<const VectorXd>& values, Index node) {
  if (values[node] > 0) return values[node];
  const double largest = values.maxCoeff();
  return largest > 0 ? largest : 1.0;
}

double traction_unit(const NodalLaws& laws, Index node) { return unit_of(laws.penalties().stiffness, node); }

double flux_unit(const NodalLaws& laws, int field, Index node) {
  return unit_of(laws.penalties().conductance.row(field).transpose(), node);
}

}  // namespace

MultiplierLayout multiplier_layout(const NodalLaws& laws) {
  return {laws.nodes(), laws.effects().scalar_fields(), laws.effects().traction};
}

VectorXd scaled_multipliers(const NodalLaws& laws) {
  const MultiplierLayout layout = multiplier_layout(laws);
  VectorXd mu(layout.size());
  for (Index node = 0; node < laws.nodes(); ++node) {
    if (laws.effects().traction)
      mu[layout.traction(node)] = laws.multipliers.traction[node] / traction_unit(laws, node);
    for (int k = 0; k < laws.effects().scalar_fields(); ++k) {
      mu[layout.flux(node, k)] = laws.multipliers.flux(k, node) / flux_unit(laws, k, node);
    }
  }
  return mu;
}

void set_scaled_multipliers(NodalLaws& laws, const VectorXd& mu) {
  const MultiplierLayout layout = multiplier_layout(laws);
  for (Index node = 0; node < laws.nodes(); ++node) {
    if (laws.effects().traction)
      laws.multipliers.traction[node] = mu[layout.traction(node)] * traction_unit(laws, node);
    for (int k = 0; k < laws.effects().scalar_fields(); ++k) {
      laws.multipliers.flux(k, node) = mu[layout.flux(node, k)] * flux_unit(laws, k, node);
    }
  }
}

NodalLoads UnknownMultipliers::predicted_loads(const LinearisationPoint& point, const FacingFields& fields) const {
  NodalLoads loads = space().averages(space().gaps(), fields, point.loads.status());
  load(loads);
  return loads;
}

VectorXd UnknownMultipliers::equation_weights(const NodalLoads& loads, const Matrix3Xd& x1) const {
  // Row k A dg_a against column k T_a, with A dg_a = -T_a.dx where the surfaces are flat, and A djump_a = F_a.dphi:
  // the sign of the traction's weight makes the two alike.
  const MultiplierLayout layout = multiplier_layout(laws());
  const VectorXd all = nodal_areas(space().facing().primary(), x1);
  VectorXd weights(layout.size());
  for (Index node = 0; node < space().nodes(); ++node) {
    if (effects().traction) {
      const double area = loads.in_contact[node] ? loads.area[node] : all[node];
      weights[layout.traction(node)] = -traction_unit(laws(), node) * area;
    }
    for (int k = 0; k < effects().scalar_fields(); ++k) {
      const double area = loads.exchanges(k, node) ? loads.flux_area(k, node) : all[node];
      weights[layout.flux(node, k)] = flux_unit(laws(), k, node) * area;
    }
  }
  return weights;
}

ConditionValue UnknownMultipliers::traction_condition(Index node, const NodalLoads& loads) const {
  const double mu = laws().multipliers.traction[node] / traction_unit(laws(), node);
  return multiplier_condition(loads.in_contact[node], mu, loads.gap[node]);
}

ConditionValue UnknownMultipliers::flux_condition(int field, Index node, const NodalLoads& loads) const {
  const double mu = laws().multipliers.flux(field, node) / flux_unit(laws(), field, node);
  return multiplier_condition(loads.exchanges(field, node), mu, loads.jump(field, node));
}

void UnknownMultipliers::equations(const NodalLoads& loads, const VectorXd& weights, double dt,
                                   const AddVector& add) const {
  const MultiplierLayout all = multiplier_layout(laws());
  for (Index node = 0; node < space().nodes(); ++node) {
    const Patch patch = space().node_patch(node, {});
    const LocalLayout layout = patch.layout();
    VectorXd residual = VectorXd::Zero(layout.size());
    if (effects().traction) {
      residual[layout.traction_multiplier()] = weights[all.traction(node)] * traction_condition(node, loads).value;
    }
    for (int k = 0; k < effects().scalar_fields(); ++k) {
      residual[layout.flux_multiplier(k)] = dt * weights[all.flux(node, k)] * flux_condition(k, node, loads).value;
    }
    add(patch, residual);
  }
}

TangentBlock UnknownMultipliers::traction_tangent(Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                                                  const VectorXd& weights) const {
  // The residual holds lambda_a traction_work, with lambda = k mu, and the condition.
  const LocalLayout layout = linear.patch.of_displacements().layout();
  const Index own = layout.traction_multiplier();
  const double weight = weights[multiplier_layout(laws()).traction(node)];
  const ConditionValue condition = traction_condition(node, loads);
  MatrixXd tangent = MatrixXd::Zero(layout.size(), layout.size());
  if (loads.in_contact[node]) {
    tangent.row(own) = weight * condition.d_dgap * linear.gap_variation.transpose();
    tangent.col(own) = traction_unit(laws(), node) * linear.traction_work;
  }
  tangent(own, own) += weight * condition.d_dmultiplier;
  return traction_block(space(), linear.patch, std::move(tangent));
}

TangentBlock UnknownMultipliers::flux_tangent(int field, Index node, const NodeLinearisation& linear,
                                              const NodalLoads& loads, const VectorXd& weights, double dt) const {
  // The residual holds dt lambda_k A_a weights, with lambda = k mu, and the condition.
  const Patch rows = linear.patch.of_field(field, false);
  const Patch columns = space().columns_of(linear.patch, field);
  const Index own = rows.layout().flux_multiplier(0);
  const Index with = columns.layout().flux_multiplier(0);
  const double weight = dt * weights[multiplier_layout(laws()).flux(node, field)];
  const ConditionValue condition = flux_condition(field, node, loads);
  const NodeLinearisation::Jump& jump = linear.jumps[field];
  MatrixXd tangent = MatrixXd::Zero(rows.layout().size(), columns.layout().size());
  if (loads.exchanges(field, node)) {
    tangent.row(own) = weight * condition.d_dgap * jump_row(jump, columns).transpose();
    tangent.col(with) = dt * flux_unit(laws(), field, node) * loads.flux_area(field, node) * jump.weights;
  }
  tangent(own, with) += weight * condition.d_dmultiplier;
  return {rows, columns, tangent};
}

std::vector<TangentBlock> UnknownMultipliers::node_tangent(Index node, const NodeLinearisation& linear,
                                                           const NodalLoads& loads, const VectorXd& weights,
                                                           double dt) const {
  std::vector<TangentBlock> blocks;
  if (effects().traction) blocks.push_back(traction_tangent(node, linear, loads, weights));
  for (int field = 0; field < effects().scalar_fields(); ++field) {
    blocks.push_back(flux_tangent(field, node, linear, loads, weights, dt));
  }
  return blocks;
}

}  // namespace mixture_contact
