#include "conditions/cohesive.h"

#include <algorithm>
#include <cmath>

namespace mixture_contact {
namespace {

/// A quantity and its derivative with respect to the gap vector and the normal.
struct Derived {
  double value = 0;
  BondGradient derivative;
};

BondGradient stacked(const Vector3d& gap, const Vector3d& normal) { return (BondGradient() << gap, normal).finished(); }

/// The opening of a bond: D_n, lambda and B with their derivatives.
struct Opening {
  double compression = 0;    ///< part of D_n in compression, min(0, D_n) [mm]
  BondGradient d_normal;     ///< derivative of the normal opening D_n
  BondGradient half_square;  ///< derivative of lambda^2/2
  double size = 0;           ///< opening lambda [mm]
  Derived mode;              ///< mode B [-]
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

/// A length that depends on the mode, and its derivative with respect to B.
struct ByPart {
  double value;
  double d_mode;
};

/// The openings o and f at which damage begins and ends.
struct Range {
  ByPart begin;
  ByPart end;

  /// The opening at which growing damage has this value.
  ByPart opening(double damage) const {
    const double left = end.value - damage * (end.value - begin.value);
    const double d_left = end.d_mode - damage * (end.d_mode - begin.d_mode);
    const double found = begin.value * end.value / left;
    return {found, (begin.d_mode * end.value + begin.value * end.d_mode - found * d_left) / left};
  }
};

Range range_of(const Cohesive& law, double penalty, double mode) {
  const double power = law.strength.power(mode);
  const double d_power = law.strength.d_power(mode);
  const ByMode& limit = law.strength.traction;
  const double begin = std::sqrt(law.strength.square(power)) / penalty;
  const double d_square = (limit.shear * limit.shear - limit.normal * limit.normal) * d_power;
  const double d_begin = d_square / (2 * penalty * penalty * begin);
  const double end = 2 * law.energy.at(power) / (penalty * begin);
  const double d_end = 2 * (law.energy.shear - law.energy.normal) * d_power / (penalty * begin) - end / begin * d_begin;
  return {{begin, d_begin}, {end, d_end}};
}

/// The retarded opening r, which damage follows; see Cohesive::pace.
Derived followed(const Cohesive& law, const Range& range, const Opening& opening, double damage) {
  const ByPart last = range.opening(damage);
  return {last.value + law.pace * (opening.size - last.value),
          (law.pace / opening.size) * opening.half_square + ((1 - law.pace) * last.d_mode) * opening.mode.derivative};
}

/// The damage d at an opening r that has not been larger before.
Derived growing_damage(const Range& range, const Derived& r, const Derived& mode) {
  const double begin = range.begin.value;
  const double end = range.end.value;
  const double size = r.value;
  if (size <= begin) return {0, BondGradient::Zero()};
  if (size >= end) return {1, BondGradient::Zero()};
  const double softening = end - begin;
  const double d_size = begin * end / (size * size * softening);
  const double by_begin = end * (size - end) / (size * softening * softening);
  const double by_end = begin * (begin - size) / (size * softening * softening);
  const double d_mode = by_begin * range.begin.d_mode + by_end * range.end.d_mode;
  return {end * (size - begin) / (size * softening), d_size * r.derivative + d_mode * mode.derivative};
}

/// Second derivatives of D_n with respect to the gap vector and the normal.
BondHessian hessian_of_normal_part() {
  BondHessian hessian = BondHessian::Zero();
  hessian.topRightCorner<3, 3>().setIdentity();
  hessian.bottomLeftCorner<3, 3>().setIdentity();
  return hessian;
}

/// The derivative of the loads at constant damage.
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
  const Range range = range_of(law, penalty, opening.mode.value);
  const bool opens = opening.size > range.opening(damage).value;
  const Derived growing = opens ? growing_damage(range, followed(law, range, opening, damage), opening.mode)
                                : Derived{damage, BondGradient::Zero()};
  const bool grows = growing.value > damage;
  BondLoad load;
  load.damage = grows ? growing.value : damage;
  const double left = penalty * (1 - load.damage);
  load.value = left * stacked(gap, Vector3d::Zero()) + penalty * load.damage * opening.compression * opening.d_normal;
  load.derivative = secant(penalty, load.damage, opening);
  if (grows) load.derivative -= penalty * opening.half_square * growing.derivative.transpose();
  return load;
}

BondHessian derivative_at(Constant constant, double penalty, double damage, const Vector3d& gap,
                          const Vector3d& normal) {
  const Opening opening = opening_of(gap, normal);
  const double square = opening.size * opening.size;
  if (constant == Constant::damage || !(square > 0)) return secant(penalty, damage, opening);
  return secant(penalty, damage, opening) -
         (penalty * (1 - damage) / square) * opening.half_square * opening.half_square.transpose();
}

double opening_size(const Vector3d& gap, const Vector3d& normal) { return opening_of(gap, normal).size; }

Dissipated dissipated(const Cohesive& law, double penalty, double before, double after, double from,
                      const Vector3d& gap, const Vector3d& normal) {
  const Opening opening = opening_of(gap, normal);
  const Range range = range_of(law, penalty, opening.mode.value);
  const double first = range.opening(before).value;
  const double last = range.opening(after).value;
  // The integrals of K r^2/2 dd and of K (lambda^2 - r^2)/2 dd along the curve of growing damage, on which dd ~ dr/r^2.
  // The opening is lambda = offset + slope r, starting from that at the start of the step; without viscosity it is r.
  const double start = std::max(first, from);
  const double slope = law.pace < 1 ? (opening.size - start) / (last - first) : 1.0;
  const double offset = law.pace < 1 ? start - slope * first : 0.0;
  const double opened = slope * slope * (last - first) + 2 * slope * offset * std::log(last / first) +
                        offset * offset * (1 / first - 1 / last);
  const double factor = 0.5 * penalty * range.begin.value * range.end.value / (range.end.value - range.begin.value);
  return {factor * (last - first), factor * (opened - (last - first))};
}

double least_penalty(const Cohesive& law) {
  const ByMode& limit = law.strength.traction;
  // The ratio f/o is a quotient of linear functions of B^eta, so its smallest value is that in tension or in shear.
  return 0.5 * std::max(limit.normal * limit.normal / law.energy.normal, limit.shear * limit.shear / law.energy.shear);
}

}  // namespace mixture_contact
