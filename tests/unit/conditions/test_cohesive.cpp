#include "contact/conditions/cohesive.h"

#include "random_contact.h"

#include <boost/test/unit_test.hpp>

using namespace test;

namespace {

constexpr double penalty = 50;
const Cohesive law{{{1, 1.5}, 2.3}, {0.1, 0.3}};

/// Gap vector and normal as one vector.
VectorXd packed(const Vector3d& gap, const Vector3d& normal) { return (VectorXd(6) << gap, normal).finished(); }

BondLoad load_at(const VectorXd& q, double damage, const Cohesive& of = law) {
  return bond_load(of, penalty, damage, q.head<3>(), q.tail<3>());
}

const Vector3d normal = Vector3d(1, -2, 2) / 3;
const Vector3d tangent = Vector3d(2, 2, 1) / 3;

/// A gap vector of this size with the mode B.
Vector3d opening(double size, double mode) { return size * (std::sqrt(1 - mode) * normal + std::sqrt(mode) * tangent); }

/// The openings o and f from their definitions.
std::pair<double, double> range(double mode) {
  const double power = std::pow(mode, law.strength.mixing);
  const double strength = std::sqrt(1 + (1.5 * 1.5 - 1) * power);
  return {strength / penalty, 2 * (0.1 + 0.2 * power) / strength};
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_traction_is_that_of_a_line_down_to_zero_and_takes_the_energy_of_the_mode) {
  for (const double mode : {0.0, 0.2, 0.5, 0.9, 1.0}) {
    const auto [begin, end] = range(mode);
    const auto size_at = [&](double size) {
      const BondGradient value = load_at(packed(opening(size, mode), normal), 0).value;
      BOOST_TEST((value.head<3>().cross(opening(1, mode))).norm() < rounding);
      return value.head<3>().dot(opening(1, mode));
    };
    BOOST_TEST(std::abs(size_at(0.5 * begin) - 0.5 * penalty * begin) < rounding);
    for (const double part : {0.1, 0.5, 0.9}) {
      const double size = begin + part * (end - begin);
      BOOST_TEST(std::abs(size_at(size) - (1 - part) * penalty * begin) < rounding);
    }
    BOOST_TEST(size_at(end) == 0.0);
    const double energy = 0.1 + 0.2 * std::pow(mode, law.strength.mixing);
    BOOST_TEST(std::abs(0.5 * penalty * begin * end - energy) < rounding);
    BOOST_TEST(std::abs(dissipated(law, penalty, 0, 1, 0, opening(end, mode), normal).by_damage - energy) < rounding);
  }
}

BOOST_AUTO_TEST_CASE(it_unloads_to_the_origin_and_damage_never_heals) {
  const auto [begin, end] = range(0.4);
  const double largest = 0.5 * (begin + end);
  const double damage = load_at(packed(opening(largest, 0.4), normal), 0).damage;
  BOOST_TEST(damage > 0.5);
  for (const double part : {0.0, 0.3, 1.0}) {
    const VectorXd q = packed(opening(part * largest, 0.4), normal);
    const BondLoad load = load_at(q, damage);
    BOOST_TEST(load.damage == damage);
    BOOST_TEST((load.value.head<3>() - penalty * (1 - damage) * q.head<3>()).norm() < rounding);
  }
  BOOST_TEST(load_at(packed(opening(largest, 1.0), normal), damage).damage >= damage);
}

BOOST_AUTO_TEST_CASE(compression_is_borne_undamaged_and_damages_nothing) {
  for (const double damage : {0.0, 0.7, 1.0}) {
    const BondLoad load = load_at(packed(-0.3 * normal, normal), damage);
    BOOST_TEST((load.value.head<3>() + 0.3 * penalty * normal).norm() < 10 * rounding);
    BOOST_TEST(load.damage == damage);
  }
}

BOOST_AUTO_TEST_CASE(energy_that_is_dissipated_adds_up_over_steps) {
  const Vector3d gap = opening(0.1, 0.3);
  const auto lost = [&](double before, double after) {
    return dissipated(law, penalty, before, after, 0, gap, normal);
  };
  BOOST_TEST(std::abs(lost(0, 0.9).by_damage - lost(0, 0.4).by_damage - lost(0.4, 0.9).by_damage) < rounding);
  BOOST_TEST(std::abs(lost(0, 0.9).by_viscosity) < rounding);
}

BOOST_AUTO_TEST_CASE(viscosity_has_damage_lag_by_the_part_of_the_step_and_takes_what_is_borne_beyond_the_law) {
  const double mode = 0.4;
  const double pace = 0.25;
  const Cohesive slow{law.strength, law.energy, pace};
  const auto [begin, end] = range(mode);
  const double first = begin + 0.2 * (end - begin);
  const double damage = load_at(packed(opening(first, mode), normal), 0).damage;
  const double size = first + 0.5 * (end - first);
  const BondLoad load = load_at(packed(opening(size, mode), normal), damage, slow);
  const double r = first + pace * (size - first);
  BOOST_TEST(std::abs(load.damage - end * (r - begin) / (r * (end - begin))) < rounding);
  BOOST_TEST(load_at(packed(opening(first + 1.01 / pace * (end - first), mode), normal), damage, slow).damage == 1.0);

  // The integral of K (lambda^2 - r^2)/2 dd by the midpoint rule with small parts of the step.
  const double from = first + 0.1 * (size - first);
  const int parts = 2000;
  const auto followed = [&, first = first](double part) { return first + part * (r - first); };
  const auto damage_of = [begin = begin, end = end](double at) { return end * (at - begin) / (at * (end - begin)); };
  double viscous = 0;
  for (int n = 0; n < parts; ++n) {
    const double middle = (n + 0.5) / parts;
    const double opened = from + middle * (size - from);
    viscous += 0.5 * penalty * (opened * opened - std::pow(followed(middle), 2)) *
               (damage_of(followed((n + 1.0) / parts)) - damage_of(followed(static_cast<double>(n) / parts)));
  }
  const Dissipated lost = dissipated(slow, penalty, damage, load.damage, from, opening(size, mode), normal);
  BOOST_TEST(viscous > 0);
  BOOST_TEST(std::abs(lost.by_viscosity - viscous) < 1e-6 * viscous);
  const Dissipated plain = dissipated(law, penalty, damage, load.damage, from, opening(size, mode), normal);
  BOOST_TEST(std::abs(lost.by_damage - plain.by_damage) < rounding);
}

// Lengths of the law (o = 0.02 and more) are well below 1. The differences therefore have a smaller step and no error
// of second order.
BOOST_AUTO_TEST_CASE(derivatives_match_differences_as_damage_grows_and_as_it_stays) {
  std::mt19937 random(11);
  const double scale = 0.02;
  for (const double along : {1.5, 0.3, -0.4}) {
    for (const double damage : {0.0, 0.1, 0.999}) {
      for (int n = 0; n < 6; ++n) {
        const Vector3d gap = 3 * scale * (along * normal + tangent + random_vector(0.3, random));
        const Cohesive at_pace{law.strength, law.energy, n % 2 == 0 ? 1.0 : 0.6};
        const auto value = [&](const VectorXd& z) {
          return VectorXd(load_at((VectorXd(6) << scale * z.head<3>(), z.tail<3>()).finished(), damage, at_pace).value);
        };
        const VectorXd z = packed(gap / scale, normal + random_vector(0.1, random));
        const BondLoad load = load_at(packed(gap, z.tail<3>()), damage, at_pace);
        BOOST_TEST((load.damage > damage) == (damage < 0.9));
        MatrixXd derivative = load.derivative;
        derivative.leftCols<3>() *= scale;
        BOOST_TEST(relative_error(derivative, fine_differences(value, z)) < difference_tolerance);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(the_derivative_is_symmetric_where_damage_stays) {
  for (const double along : {0.02, -0.02}) {
    const BondHessian derivative = load_at(packed(along * normal + 0.03 * tangent, normal), 0.99).derivative;
    BOOST_TEST((derivative - derivative.transpose()).norm() <= rounding * derivative.norm());
    BOOST_TEST(derivative.bottomRightCorner(3, 3).norm() * along <= 0.0);
  }
}

// The law has the same strength and energy in both modes, and therefore a potential: stored and dissipated energy.
BOOST_AUTO_TEST_CASE(energy_is_below_its_expansion_at_constant_damage_as_long_as_the_bond_does_not_close) {
  const Cohesive even{{{1, 1}, 2}, {0.1, 0.1}};
  const auto damage_at = [&](const Vector3d& gap) { return load_at(packed(gap, normal), 0, even).damage; };
  const auto energy = [&](const Vector3d& gap) {
    const double damage = damage_at(gap);
    const double lost = damage > 0 ? dissipated(even, penalty, 0, damage, 0, gap, normal).by_damage : 0.0;
    return 0.5 * penalty * (1 - damage) * gap.squaredNorm() + lost;
  };
  std::mt19937 random(5);
  for (const double size : {0.03, 0.1, 0.18}) {
    const Vector3d gap = opening(size, 0.9);
    const Vector3d traction = load_at(packed(gap, normal), 0, even).value.head<3>();
    const Eigen::Matrix3d stiffness = derivative_at(Constant::damage, penalty, damage_at(gap), gap, normal)
                                          .topLeftCorner<3, 3>();
    for (int n = 0; n < 200; ++n) {
      Vector3d move = random_vector(0.3, random);
      move += std::max(0.0, -(gap + move).dot(normal)) * normal;
      BOOST_TEST(energy(gap + move) <= energy(gap) + traction.dot(move) + 0.5 * move.dot(stiffness * move) + rounding);
    }
  }
}

BOOST_AUTO_TEST_CASE(softer_penalties_than_the_least_one_have_no_softening) {
  const double least = least_penalty(law);
  BOOST_TEST(std::abs(least - 0.5 * std::max(1 / 0.1, 1.5 * 1.5 / 0.3)) < rounding);
}

BOOST_AUTO_TEST_CASE(a_brittle_bond_breaks_beyond_its_strength_in_each_mode_and_not_by_compression) {
  const Brittle bond{{2, 3}};
  BOOST_TEST(!exceeds(bond, 1.999 * normal, normal));
  BOOST_TEST(exceeds(bond, 2.001 * normal, normal));
  BOOST_TEST(!exceeds(bond, 2.999 * tangent, normal));
  BOOST_TEST(exceeds(bond, 3.001 * tangent, normal));
  BOOST_TEST(!exceeds(bond, -50 * normal, normal));
  BOOST_TEST(exceeds(bond, -50 * normal + 3.001 * tangent, normal));
  const double mixed = std::sqrt(2 / (1 / 4.0 + 1 / 9.0));  // equal parts of tension and shear
  const Vector3d direction = (normal + tangent) / std::sqrt(2.0);
  BOOST_TEST(!exceeds(bond, 0.999 * mixed * direction, normal));
  BOOST_TEST(exceeds(bond, 1.001 * mixed * direction, normal));
  BOOST_TEST(!exceeds(bond, Vector3d::Zero(), normal));
}
