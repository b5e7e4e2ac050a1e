#include "mortar/trial_variation.h"

#include "base/parallel.h"

namespace mixture_contact {

Matrix3Xd trial_variation(const NodalLaws& laws, Index node, const NodeLinearisation& linear,
                          const NodalFriction& friction) {
  // The trial is tau = (1 - n n) F v with v = lambda - eps s. Therefore dtau = (1 - n n) (F dv + dF v) - dn (n.F v) - n
  // (dn.F v), where dv = -eps ds, dF v = sum_b dx_b (C_b.v), and dn = (1 - n n) dm/|m| for the mean area vector m.
  const SlipLinearisation& vary = linear.friction;
  const FrictionTrial trial = friction.geometric.size() > 0
                                  ? carried_trial(friction, node, friction.geometric.col(node))
                                  : friction_trial(laws, friction, node);
  const Vector3d& n = trial.normal;
  const Eigen::Matrix3d in_plane = Eigen::Matrix3d::Identity() - n * n.transpose();
  const double size = friction.area_vector.col(node).norm();
  const Eigen::Matrix3d by_normal = (in_plane * n.dot(trial.carried) + n * trial.value.transpose()) / size;
  const Eigen::Matrix3d by_slip = laws.friction_penalty(node) * in_plane * friction.convection[node];
  const Eigen::Matrix<double, 3, 6> by_average = (Eigen::Matrix<double, 3, 6>() << -by_slip, -by_normal).finished();
  Matrix3Xd change(3, 3 * vary.average_variation.count());
  for (Index b = 0; b < vary.turning; ++b)
    change.middleCols<3>(3 * b) = by_average.lazyProduct(vary.average_variation[b]);
  for (Index b = vary.turning; b < vary.average_variation.count(); ++b)
    change.middleCols<3>(3 * b) = by_average.leftCols<3>().lazyProduct(vary.average_variation[b].topRows<3>());
  for (Index b = 0; b < vary.convection.cols(); ++b)
    change.middleCols<3>(3 * b) += vary.convection.col(b).dot(trial.past) * in_plane;
  return change;
}

void vary_trials(const NodalLaws& laws, const NodalLoads& loads, IndexedVector<NodeLinearisation>& nodes) {
  in_parallel(loads.friction.slip.cols(), [&](Index node) {
    if (nodes[node].empty() || !loads.in_contact[node]) return;
    nodes[node].friction.trial_variation = trial_variation(laws, node, nodes[node], loads.friction);
  });
}

}  // namespace mixture_contact
