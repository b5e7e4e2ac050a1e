#include "geometry/rigid_motion.h"

#include <algorithm>

namespace mixture_contact {
namespace {

/// The vector of the rotation between two poses of a body [rad]; zero if it has not turned.
Vector3d rotation_between(const RigidPose& from, const RigidPose& to) {
  if (from.rotation.coeffs() == to.rotation.coeffs()) return Vector3d::Zero();
  const Eigen::AngleAxisd turn(to.rotation * from.rotation.conjugate());
  return turn.angle() * turn.axis();
}

}  // namespace

Matrix3Xd beyond_linear(const RigidParts& from, const RigidParts& to, const Matrix3Xd& before, const Matrix3Xd& after) {
  IndexedVector<Vector3d> rotation;
  for (Index body = 0; body < from.poses.count(); ++body)
    rotation.push_back(rotation_between(from.poses[body], to.poses[body]));
  const bool none = std::all_of(rotation.begin(), rotation.end(), [](const Vector3d& each) { return each.isZero(0); });
  if (none) return {};
  Matrix3Xd beyond = Matrix3Xd::Zero(3, before.cols());
  for (Index node = 0; node < from.body.count(); ++node) {
    const int body = from.body[node];
    if (body < 0 || rotation[body].isZero(0)) continue;
    const Vector3d arm = before.col(node) - from.poses[body].centre;
    const Vector3d linear = to.poses[body].centre - from.poses[body].centre + rotation[body].cross(arm);
    beyond.col(node) = after.col(node) - before.col(node) - linear;
  }
  return beyond;
}

}  // namespace mixture_contact
