#include "enforcement/fixed_geometry.h"

#include "base/in_order.h"

namespace mixture_contact {
namespace {

/// The flux part of (2.5) at a node, for fluxes that psi_a interpolates between nodes: dt sum_a phi_a INT psi_a h da =
/// dt sum_a phi_a A_a weights.
VectorXd flux_residual(Index node, const NodeLinearisation& linear, const NodalLoads& loads, double dt) {
  const LocalLayout layout = linear.patch.layout();
  VectorXd residual = VectorXd::Zero(layout.size());
  for (Index k = 0; k < linear.jumps.count(); ++k) {
    const int field = linear.patch.fields[k];
    if (!loads.exchanges(field, node)) continue;
    const double flow = dt * loads.flux(field, node) * loads.flux_area(field, node);
    for (Index n = 0; n < layout.nodes(); ++n) residual[layout.scalar(n, k)] = flow * linear.jumps[k].weights[n];
  }
  return residual;
}

}  // namespace

FixedGeometry::FixedGeometry(PassParts& parts) : parts_(parts), nodes_(parts.space.nodes()) {
  const MortarSpace& space = parts_.space;
  const Index fields = space.effects().scalar_fields();
  fixed_.in_contact = fixed_.flux_coupled = NodeFlags(space.nodes(), false);
  fixed_.area.setZero(space.nodes());
  fixed_.gap.setZero(space.nodes());
  fixed_.flux_area.setZero(fields, space.nodes());
  fixed_.jump.setZero(fields, space.nodes());
  parts_.method->load(parts_.laws, fixed_);
}

void FixedGeometry::update(const FacingPositions& x) {
  const Index fields = parts_.space.effects().scalar_fields();
  parts_.space.boundary_weights().reconsider();
  parts_.space.update_boundary_weights(x);
  const SurfaceFields primary{x.primary, MatrixXd::Zero(x.primary.cols(), fields), {}};
  const SurfaceFields secondary{x.secondary, MatrixXd::Zero(x.secondary.cols(), fields), {}};
  NodalGaps gaps = parts_.space.gaps();
  const NodeFlags status = parts_.active_set.initial(parts_.laws, gaps);
  fixed_ = parts_.space.averages(std::move(gaps), {primary, secondary}, {status, status, {}});
  fixed_.traction.setZero(parts_.space.nodes());
  fixed_.flux.setZero(fields, parts_.space.nodes());
  nodes_ = linearise(parts_.space, fixed_, {primary, secondary});
}

void FixedGeometry::end_iterations() {
  parts_.space.boundary_weights().reconsider();
  parts_.space.change_facing().end_iterations();
}

NodalLoads FixedGeometry::loads(const FacingFields& fields) const {
  NodalLoads loads = fixed_;
  loads.own = own_values(fields, parts_.space.effects());
  in_parallel(nodes_.count(), [&](Index node) {
    const NodeLinearisation& linear = nodes_[node];
    for (Index k = 0; k < linear.jumps.count(); ++k) {
      loads.jump(linear.patch.fields[k], node) = jump_of(linear, k, fields);
    }
  });
  parts_.method->load(parts_.laws, loads);
  return loads;
}

void FixedGeometry::residual(const FacingFields& fields, double dt, const AddVector& add) const {
  const NodalLoads now = loads(fields);
  const auto of_node = [&](Index node) { return flux_residual(node, nodes_[node], now, dt); };
  in_order(nodes_.count(), of_node, [&](Index node, const VectorXd& sum) {
    if (sum.size() > 0) add(nodes_[node].patch, sum);
  });
  parts_.method->equations(parts_, now, parts_.method->equation_weights(parts_, now, fields.primary.position), dt, add);
}

void FixedGeometry::tangent(const FacingFields& fields, double dt, const TangentParts& add) const {
  const NodalLoads now = loads(fields);
  const VectorXd weights = parts_.method->equation_weights(parts_, now, fields.primary.position);
  node_tangents(parts_, nodes_, now, weights, dt, add);
}

void FixedGeometry::for_each_coupling(const Couplings& use) const {
  for (Index node = 0; node < nodes_.count(); ++node) {
    if (!nodes_[node].empty()) use_node(parts_, node, nodes_[node].patch, use);
  }
}

}  // namespace mixture_contact
