#include "enforcement/unknown_multipliers.h"

#include <utility>

namespace mixture_contact {
namespace {

/// The value of a node. If it is zero (impermeable facets around the node), the largest value of the surface, or one.
double unit_of(const Eigen::Ref<const VectorXd>& values, Index node) {
  if (values[node] > 0) return values[node];
  const double largest = values.maxCoeff();
  return largest > 0 ? largest : 1.0;
}

double traction_unit(const NodalLaws& laws, Index node) { return unit_of(laws.penalties().stiffness, node); }

double flux_unit(const NodalLaws& laws, int field, Index node) {
  return unit_of(laws.penalties().conductance.row(field).transpose(), node);
}

/// The block of a traction multiplier without nodes.
MatrixXd alone(const LocalLayout& layout, double value) {
  MatrixXd block = MatrixXd::Zero(layout.size(), layout.size());
  block(layout.traction_multiplier(), layout.traction_multiplier()) = value;
  return block;
}

/// The quantity that takes the place of the gap in the equation of a field: the jump of a continuous field, or the
/// flux of a law.
FluxLaw driving(const NodalLaws& laws, int field, Index node, const NodalLoads& loads) {
  return laws.scalar(field).flux(loads, node, {0, 1});
}

ConditionValue traction_condition(const NodalLaws& laws, Index node, const NodalLoads& loads) {
  const double mu = laws.multipliers.traction[node] / traction_unit(laws, node);
  // A soft gap has a penalty of the stiffness, lambda = k g.
  const double compliance = laws.has_soft_gap(node) ? 1.0 : multiplier_compliance;
  return multiplier_condition(loads.in_contact[node], mu, loads.gap[node], compliance);
}

ConditionValue flux_condition(const NodalLaws& laws, int field, Index node, const NodalLoads& loads) {
  const double unit = flux_unit(laws, field, node);
  const double mu = laws.multipliers.flux(field, node) / unit;
  const bool exchanges = loads.exchanges(field, node);
  if (!exchanges || laws.scalar(field).is_enforced())
    return multiplier_condition(exchanges, mu, loads.jump(field, node));
  return law_condition(mu, unit, laws.flux_penalty(field, node), driving(laws, field, node, loads).value);
}

/// Adds the blocks of a traction multiplier, and of each node with this multiplier.
void add_traction_tangent(const PassNodes& at, Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                          const VectorXd& weights, std::vector<TangentBlock>& blocks) {
  // The residual contains lambda_a traction_work, with lambda = k mu, and the condition.
  const double weight = weights[multiplier_layout(at.laws).traction(node)];
  const ConditionValue condition = traction_condition(at.laws, node, loads);
  const Patch own_alone = linear.patch.of_multipliers();
  blocks.push_back(
      traction_block(at.space, own_alone, alone(own_alone.displacement_layout(), weight * condition.d_dmultiplier)));
  if (!loads.in_contact[node]) return;
  const double unit = traction_unit(at.laws, node);
  for (Index n = 0; n < linear.patch.layout().nodes(); ++n) {
    const Patch patch = linear.patch.of_node(n);
    const LocalLayout layout = patch.displacement_layout();
    MatrixXd tangent = MatrixXd::Zero(layout.size(), layout.size());
    const Index own = layout.traction_multiplier();
    tangent.block<1, 3>(own, 0) = weight * condition.d_dgap * linear.gap_variation.segment<3>(3 * n).transpose();
    tangent.block<3, 1>(0, own) = unit * linear.traction_work.segment<3>(3 * n);
    blocks.push_back(traction_block(at.space, patch, std::move(tangent)));
  }
}

/// Adds the blocks of a flux multiplier, and of each node with this multiplier.
void add_flux_tangent(const PassNodes& at, int field, Index node, const NodeLinearisation& linear,
                      const NodalLoads& loads, const VectorXd& weights, double dt, std::vector<TangentBlock>& blocks) {
  // The residual contains dt lambda_k A_a weights, with lambda = k mu, and the condition.
  const double weight = dt * weights[multiplier_layout(at.laws).flux(node, field)];
  const ConditionValue condition = flux_condition(at.laws, field, node, loads);
  const Patch alone = linear.patch.of_multipliers();
  blocks.push_back({alone.of_field(field, false), alone.of_field(field, false),
                    MatrixXd::Constant(1, 1, weight * condition.d_dmultiplier)});
  if (!loads.exchanges(field, node)) return;
  const NodeLinearisation::Jump& jump = linear.jumps[field];
  const Patch all = flux_columns(at, linear.patch, field);
  const VectorXd row = weight * condition.d_dgap *
                       flux_row(driving(at.laws, field, node, loads), node, linear, all, at.space.symmetric());
  const double flow = dt * flux_unit(at.laws, field, node) * loads.flux_area(field, node);
  for (Index n = 0; n < linear.patch.layout().nodes(); ++n) {
    const Patch patch = linear.patch.of_node(n);
    const Patch rows = patch.of_field(field, false);
    const Patch columns = flux_columns(at, patch, field);
    const LocalLayout layout = columns.layout();
    MatrixXd tangent = MatrixXd::Zero(rows.layout().size(), layout.size());
    tangent.row(rows.layout().flux_multiplier(0))
        .head(layout.per_node()) = row.segment(n * layout.per_node(), layout.per_node()).transpose();
    tangent(0, layout.flux_multiplier(0)) = flow * jump.weights[n];
    blocks.push_back({rows, columns, std::move(tangent)});
  }
}

}  // namespace

MultiplierLayout multiplier_layout(const NodalLaws& laws) { return {laws.nodes(), laws.effects()}; }

VectorXd scaled_multipliers(const NodalLaws& laws) {
  const MultiplierLayout layout = multiplier_layout(laws);
  VectorXd mu(layout.size());
  for (Index node = 0; node < laws.nodes(); ++node) {
    if (layout.has_tractions()) mu[layout.traction(node)] = laws.multipliers.traction[node] / traction_unit(laws, node);
    for (int k = 0; k < laws.effects().scalar_fields(); ++k) {
      mu[layout.flux(node, k)] = laws.multipliers.flux(k, node) / flux_unit(laws, k, node);
    }
  }
  return mu;
}

void set_scaled_multipliers(NodalLaws& laws, const VectorXd& mu) {
  const MultiplierLayout layout = multiplier_layout(laws);
  for (Index node = 0; node < laws.nodes(); ++node) {
    if (layout.has_tractions()) laws.multipliers.traction[node] = mu[layout.traction(node)] * traction_unit(laws, node);
    for (int k = 0; k < laws.effects().scalar_fields(); ++k) {
      laws.multipliers.flux(k, node) = mu[layout.flux(node, k)] * flux_unit(laws, k, node);
    }
  }
}

NodalLoads UnknownMultipliers::predicted_loads(const PassNodes& at, const LinearisationPoint& point,
                                               const FacingFields& fields) const {
  NodalLoads loads = at.space.averages(at.space.gaps(), fields, point.loads.status());
  load(at.laws, loads);
  return loads;
}

VectorXd UnknownMultipliers::equation_weights(const PassNodes& at, const NodalLoads& loads, const Matrix3Xd& x1) const {
  // The row of a multiplier is k A dg_a and its column k T_a, where A dg_a = -T_a.dx if the surfaces are flat, and A
  // djump_a = F_a.dphi. The sign of the traction's weight makes row and column equal.
  const MultiplierLayout layout = multiplier_layout(at.laws);
  const VectorXd all = nodal_areas(at.space.facing().primary(), x1);
  VectorXd weights(layout.size());
  for (Index node = 0; node < at.space.nodes(); ++node) {
    if (layout.has_tractions()) {
      const double area = loads.in_contact[node] ? loads.area[node] : all[node];
      weights[layout.traction(node)] = -traction_unit(at.laws, node) * area;
    }
    for (int k = 0; k < at.effects().scalar_fields(); ++k) {
      const double area = loads.exchanges(k, node) ? loads.flux_area(k, node) : all[node];
      weights[layout.flux(node, k)] = flux_unit(at.laws, k, node) * area;
    }
  }
  return weights;
}

void UnknownMultipliers::equations(const PassNodes& at, const NodalLoads& loads, const VectorXd& weights, double dt,
                                   const AddVector& add) const {
  const MultiplierLayout all = multiplier_layout(at.laws);
  for (Index node = 0; node < at.space.nodes(); ++node) {
    const Patch patch = at.space.node_patch(node, {});
    const LocalLayout layout = patch.layout();
    VectorXd residual = VectorXd::Zero(layout.size());
    if (layout.has_displacements()) {
      residual[layout.traction_multiplier()] = weights[all.traction(node)] *
                                               traction_condition(at.laws, node, loads).value;
    }
    for (int k = 0; k < at.effects().scalar_fields(); ++k) {
      residual[layout.flux_multiplier(k)] = dt * weights[all.flux(node, k)] *
                                            flux_condition(at.laws, k, node, loads).value;
    }
    add(patch, residual);
  }
}

void UnknownMultipliers::for_each_coupling(const Patch& patch, const UsePatch& use) const {
  use(patch.of_multipliers());
  for (Index n = 0; n < patch.layout().nodes(); ++n) use(patch.of_node(n));
}

NodeTangent UnknownMultipliers::node_tangent(const PassNodes& at, Index node, const NodeLinearisation& linear,
                                             const NodalLoads& loads, const VectorXd& weights, double dt) const {
  NodeTangent tangent;
  if (linear.patch.displacements) add_traction_tangent(at, node, linear, loads, weights, tangent.blocks);
  for (int field = 0; field < at.effects().scalar_fields(); ++field) {
    add_flux_tangent(at, field, node, linear, loads, weights, dt, tangent.blocks);
  }
  return tangent;
}

}  // namespace mixture_contact
