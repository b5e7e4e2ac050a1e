/// Residual (2.5), tangent (2.6) and matrix profile: a part of ContactPass.
#include "pass.h"

namespace mixture_contact {

void ContactPass::residual(const SurfaceFields& primary, const SurfaceFields& secondary, double dt,
                           const std::function<void(const Patch&, const VectorXd&)>& add) const {
  const NodalLoads loads = nodal_loads(primary, secondary);
  for (const FacetPair& pair : pairs_) {
    if (!carries_load(pair, loads.in_contact)) continue;
    const Patch patch = facet_patch(pair);
    VectorXd sum = VectorXd::Zero(patch.layout().size());
    for (const IntegrationPoint& place : pair.points) {
      const PointContact point = contact(pair, place, loads, primary, secondary, dt);
      sum += point_residual(point.kinematics, point.loads, patch.layout());
    }
    add(patch, sum);
  }
  if (!has_unknown_multipliers()) return;
  const VectorXd weights = present_multiplier_weights(loads, primary.position);
  for (Index node = 0; node < primary_.nodes; ++node) {
    add(node_patch(node, {}), multiplier_residual(node, loads, weights, dt));
  }
}

void ContactPass::tangent(const SurfaceFields& primary, const SurfaceFields& secondary, double dt,
                          const std::function<void(const Patch&, const MatrixXd&)>& add) const {
  const auto add_full_or_symmetric = [&](const Patch& patch, const MatrixXd& values) {
    add(patch, settings_.symmetric ? symmetric_part(values, patch.layout()) : values);
  };
  NodalLoads loads = nodal_loads(primary, secondary);
  std::vector<NodeLinearisation> present;
  if (!held_) present = linearise(loads, primary, secondary);
  const std::vector<NodeLinearisation>& nodes = held_ ? held_->nodes : present;
  const VectorXd weights = present_multiplier_weights(loads, primary.position);
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    if (nodes[node].unknowns.size() == 0) continue;
    const auto index = static_cast<Index>(node);
    add_full_or_symmetric(nodes[node].patch, has_unknown_multipliers()
                                                 ? multiplier_tangent(index, nodes[node], loads, weights, dt)
                                                 : law_tangent(index, nodes[node], loads, dt));
  }
  if (held_) {
    loads.traction = held_->geometric_traction;
    loads.flux = held_->geometric_flux;
  }
  for (const FacetPair& pair : pairs_) {
    if (!carries_load(pair, loads.in_contact)) continue;
    const Patch patch = facet_patch(pair);
    const std::vector<PointMotion> motions = points_->motions(pair, primary.position, secondary.position);
    MatrixXd sum = MatrixXd::Zero(patch.layout().size(), patch.layout().size());
    for (std::size_t q = 0; q < pair.points.size(); ++q) {
      const PointContact point = contact(pair, pair.points[q], loads, primary, secondary, dt);
      const KinematicVariations vary = kinematic_variations(point.kinematics, motions[q]);
      sum += point_tangent(point.kinematics, vary, point.loads, point.values, patch.layout());
    }
    add_full_or_symmetric(patch, sum);
  }
}

MatrixXd ContactPass::law_tangent(Index node, const NodeLinearisation& linear, const NodalLoads& loads,
                                  double dt) const {
  // The residual holds t_a traction_work + dt phi_a flux_work; the variation of the works is the geometric part.
  MatrixXd tangent = traction_penalty(node) * linear.traction_work * linear.gap_variation.transpose();
  for (std::size_t k = 0; k < linear.patch.fields.size(); ++k) {
    const int field = linear.patch.fields[k];
    if (!passes(loads, field, node)) continue;
    tangent += dt * flux_penalty(field, node) * linear.flux_work[k] * linear.jump_variation[k].transpose();
  }
  return tangent;
}

void ContactPass::for_each_coupling(const Matrix3Xd& x1, const Matrix3Xd& x2,
                                    const std::function<void(const Patch&)>& use) const {
  // A node's patch holds the facet pairs of all points that its loads act at.
  const auto around = pairs_around_nodes(held_ ? held_->loads.in_contact : natural_status(x1, x2));
  for (std::size_t node = 0; node < around.size(); ++node) {
    if (!around[node].empty() || has_unknown_multipliers()) use(node_patch(static_cast<Index>(node), around[node]));
  }
}

}  // namespace mixture_contact
