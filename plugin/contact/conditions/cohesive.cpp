#include "conditions/cohesive.h"

#include <algorithm>
#include <cmath>

namespace mixture_contact {
namespace {

/// A quantity with its derivative.
struct Derived {
  double value = 0;
  BondGradient derivative;
};

BondGradient stacked(const Vector3d& gap, const Vector3d& normal) { return (BondGradient() << gap, normal).finished(); }

/// A bond's opening, D_n, lambda and B.
struct Opening {
  double compression = 0;    ///< min(0, D_n) [mm]
  BondGradient d_normal;     ///< dD_n
  BondGradient half_square;  ///< d(lambda^2/2)
  double size = 0;           ///< lambda [mm]
  Derived mode;              ///< B [-]
};

Opening opening_of(const Vector3d& gap, const Vector3d& normal) {
  const double along = gap.dot(normal);
  Opening found;
  found.compression = std::min(0.0, along);
  found.d_normal = stacked(normal, gap);
  found.half_square = stacked(gap, Vector3d::Zero()) - found.compression * found.d_normal;
  const double square = gap.squaredNorm() - found.compression * found.compression;
  found.size = std::sqrt(std::max(0.0, square));
  found.mode = {1, BondGradient::Zero()};
  if (along > 0) {
    const double tension = along * along / square;
    found.mode.value = std::max(0.0, 1 - tension);
    found.mode.derivative = (2 / square) * (tension * found.half_square - along * found.d_normal);
  }
  return found;
}

/// Where damage begins and ends, o and f, with their derivatives with B.
struct Range {
  double begin;
  double end;
  double d_begin;
  double d_end;

  /// lambda at a damage that grows.
  double opening(double damage) const { return begin * end / (end - damage * (end - begin)); }
};

Range range_of(const Cohesive& law, double penalty, double mode) {
  const double power = law.strength.power(mode);
  const double d_power = law.strength.d_power(mode);
  const ByMode& limit = law.strength.traction;
  Range range{};
  range.begin = std::sqrt(law.strength.square(power)) / penalty;
  range.end = 2 * law.energy.at(power) / (penalty * range.begin);
  const double d_square = (limit.shear * limit.shear - limit.normal * limit.normal) * d_power;
  range.d_begin = d_square / (2 * penalty * penalty * range.begin);
  range.d_end = 2 * (law.energy.shear - law.energy.normal) * d_power / (penalty * range.begin) -
                range.end / range.begin * range.d_begin;
  return range;
}

/// d at an opening that has not been larger.
Derived growing_damage(const Range& range, const Opening& opening) {
  const double size = opening.size;
  if (size <= range.begin) return {0, BondGradient::Zero()};
  if (size >= range.end) return {1, BondGradient::Zero()};
  const double softening = range.end - range.begin;
  const double d_size = range.begin * range.end / (size * size * softening);
  const double by_begin = range.end * (size - range.end) / (size * softening * softening);
  const double by_end = range.begin * (range.begin - size) / (size * softening * softening);
  const double d_mode = by_begin * range.d_begin + by_end * range.d_end;
  return {range.end * (size - range.begin) / (size * softening),
          (d_size / size) * opening.half_square + d_mode * opening.mode.derivative};
}

/// Second derivatives of D_n.
BondHessian hessian_of_normal_part() {
  BondHessian hessian = BondHessian::Zero();
  hessian.topRightCorner<3, 3>().setIdentity();
  hessian.bottomLeftCorner<3, 3>().setIdentity();
  return hessian;
}

/// The derivative of the loads at a damage that stays.
BondHessian secant(double penalty, double damage, const Opening& opening) {
  BondHessian derivative = BondHessian::Zero();
  derivative.topLeftCorner<3, 3>().diagonal().setConstant(penalty * (1 - damage));
  if (opening.compression < 0)
    derivative += penalty * damage *
                  (opening.d_normal * opening.d_normal.transpose() + opening.compression * hessian_of_normal_part());
  return derivative;
}

}  // namespace

BondLoad bond_load(const Cohesive& law, double penalty, double damage, const Vector3d& gap, const Vector3d& normal) {
  const Opening opening = opening_of(gap, normal);
  const Derived growing = growing_damage(range_of(law, penalty, opening.mode.value), opening);
  const bool grows = growing.value > damage;
  BondLoad load;
  load.damage = grows ? growing.value : damage;
  const double left = penalty * (1 - load.damage);
  load.value = left * stacked(gap, Vector3d::Zero()) + penalty * load.damage * opening.compression * opening.d_normal;
  load.derivative = secant(penalty, load.damage, opening);
  if (grows) load.derivative -= penalty * opening.half_square * growing.derivative.transpose();
  return load;
}

BondHessian yielding_derivative(double penalty, double damage, const Vector3d& gap, const Vector3d& normal) {
  const Opening opening = opening_of(gap, normal);
  const double square = opening.size * opening.size;
  if (!(square > 0)) return secant(penalty, damage, opening);
  return secant(penalty, damage, opening) -
         (penalty * (1 - damage) / square) * opening.half_square * opening.half_square.transpose();
}

double dissipated(const Cohesive& law, double penalty, double before, double after, const Vector3d& gap,
                  const Vector3d& normal) {
  const Range range = range_of(law, penalty, opening_of(gap, normal).mode.value);
  // The integral of K lambda^2/2 dd along the curve of growing damage.
  return 0.5 * penalty * range.begin * range.end * (range.opening(after) - range.opening(before)) /
         (range.end - range.begin);
}

double least_penalty(const Cohesive& law) {
  const ByMode& limit = law.strength.traction;
  // f/o is a quotient of linear functions of B^eta, so that its least value is that of tension or of shear.
  return 0.5 * std::max(limit.normal * limit.normal / law.energy.normal, limit.shear * limit.shear / law.energy.shear);
}

}  // namespace mixture_contact
