/// Surfaces that cannot move exchange no traction, and fluxes that are linear in the fields: a part of ContactPass.
#include "base/parallel.h"
#include "interface/pass.h"

namespace mixture_contact {

ContactPass::Frozen ContactPass::freeze(const Matrix3Xd& x1, const Matrix3Xd& x2) const {
  const SurfaceFields primary{x1, MatrixXd::Zero(x1.cols(), effects_.scalar_fields())};
  const SurfaceFields secondary{x2, MatrixXd::Zero(x2.cols(), effects_.scalar_fields())};
  const std::vector<bool> status = natural_status(x1, x2);
  Frozen frozen{averages(primary, secondary, status, status), {}};
  frozen.geometry.traction.setZero(primary_.nodes);
  frozen.geometry.flux.setZero(effects_.scalar_fields(), primary_.nodes);
  frozen.nodes = linearise(frozen.geometry, primary, secondary);
  return frozen;
}

NodalLoads ContactPass::frozen_loads(const Frozen& frozen, const SurfaceFields& primary,
                                     const SurfaceFields& secondary) const {
  NodalLoads loads = frozen.geometry;
  in_parallel(frozen.nodes.size(), [&](std::size_t node) {
    const NodeLinearisation& linear = frozen.nodes[node];
    for (std::size_t k = 0; k < linear.jumps.size(); ++k) {
      loads.jump(linear.patch.fields[k], static_cast<Index>(node)) = jump_of(linear, k, primary, secondary);
    }
  });
  apply_laws(loads);
  return loads;
}

VectorXd ContactPass::frozen_residual(Index node, const NodeLinearisation& linear, const NodalLoads& loads, double dt) {
  // (2.5) with fluxes between nodes interpolated with psi_a: dt sum_a phi_a INT psi_a h da = dt sum_a phi_a A_a
  // weights.
  const LocalLayout layout = linear.patch.layout();
  VectorXd residual = VectorXd::Zero(layout.size());
  for (std::size_t k = 0; k < linear.jumps.size(); ++k) {
    const int field = linear.patch.fields[k];
    if (!passes(loads, field, node)) continue;
    const double flow = dt * loads.flux(field, node) * loads.flux_area(field, node);
    for (Index n = 0; n < layout.nodes(); ++n) {
      residual[layout.scalar(n, static_cast<Index>(k))] = flow * linear.jumps[k].weights[n];
    }
  }
  return residual;
}

}  // namespace mixture_contact
