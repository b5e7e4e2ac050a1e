#include "conditions/friction.h"

#include <algorithm>

namespace mixture_contact {

FrictionBound friction_bound(const FrictionRule& rule, double normal_traction, double excess_pressure) {
  const FrictionBound bound = linear_friction_bound(rule, normal_traction, excess_pressure);
  return bound.value > 0 ? bound : FrictionBound{0, 0, 0};
}

FrictionBound linear_friction_bound(const FrictionRule& rule, double normal_traction, double excess_pressure) {
  const double by_fluid = 1 - rule.contact_fraction;
  const double by_solid = -normal_traction - by_fluid * excess_pressure;
  return {rule.coefficient * by_solid, -rule.coefficient, -rule.coefficient * by_fluid};
}

FrictionTraction stick(const Vector3d& trial) { return {trial, Eigen::Matrix3d::Identity(), Vector3d::Zero()}; }

FrictionTraction slip(const Vector3d& trial, double bound) {
  const double size = trial.norm();
  if (!(size > 0)) return {Vector3d::Zero(), Eigen::Matrix3d::Zero(), Vector3d::Zero()};
  const Vector3d direction = trial / size;
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - direction * direction.transpose();
  return {bound * direction, bound / size * across, direction};
}

FrictionTraction slip(const Vector3d& trial, double bound, const Vector3d& reference, double reference_bound) {
  const double size = reference.norm();
  if (!(size > 0)) return slip(trial, bound);
  const Vector3d first = reference / size;
  const Eigen::Matrix3d turning = (Eigen::Matrix3d::Identity() - first * first.transpose()) / size;
  const FrictionTraction along = slip(first + turning * trial, 1);
  return {bound * first + reference_bound * (along.value - first), reference_bound * along.d_trial * turning, first};
}

double slip_excess(const Vector3d& trial, double bound, const Vector3d& reference) {
  const double size = reference.norm();
  return (size > 0 ? trial.dot(reference) / size : trial.norm()) - bound;
}

double dissipated(const Vector3d& trial, double bound, double penalty) {
  return penalty > 0 && bound > 0 ? bound * std::max(0.0, trial.norm() - bound) / penalty : 0.0;
}

}  // namespace mixture_contact
