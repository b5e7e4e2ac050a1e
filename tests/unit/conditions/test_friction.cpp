#include "contact/conditions/friction.h"

#include "random_contact.h"

#include <boost/test/unit_test.hpp>

using namespace test;

namespace {

FrictionRule rule_of(double coefficient, double contact_fraction) {
  FrictionRule rule;
  rule.coefficient = coefficient;
  rule.contact_fraction = contact_fraction;
  return rule;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_bound_is_the_coefficient_times_what_the_solid_bears) {
  BOOST_TEST(friction_bound(rule_of(0.3, 0), -2, 0).value == 0.6);
  BOOST_TEST(friction_bound(rule_of(0.5, 0), -2, 1.5).value == 0.25);
  BOOST_TEST(friction_bound(rule_of(0.5, 1), -2, 1.5).value == 1.0);    // the fluid bears no load
  BOOST_TEST(friction_bound(rule_of(0.5, 0.5), -2, -1).value == 1.25);  // suction presses the solids together
  BOOST_TEST(friction_bound(rule_of(0.5, 0), -2, 2.5).value == 0.0);    // never negative
  BOOST_TEST(friction_bound(rule_of(0.5, 0), 1, 0).value == 0.0);       // also zero in tension
}

BOOST_AUTO_TEST_CASE(the_linear_bound_is_the_same_where_the_solids_are_pressed_and_goes_on_below_zero) {
  for (const double traction : {-2.0, -0.5, 0.5}) {
    for (const double pressure : {-1.0, 0.0, 1.0}) {
      const FrictionBound linear = linear_friction_bound(rule_of(0.5, 0.25), traction, pressure);
      BOOST_TEST(linear.value == 0.5 * (-traction - 0.75 * pressure));
      BOOST_TEST(linear.d_traction == -0.5);
      BOOST_TEST(linear.d_pressure == -0.375);
      BOOST_TEST(friction_bound(rule_of(0.5, 0.25), traction, pressure).value == std::max(0.0, linear.value));
    }
  }
}

BOOST_AUTO_TEST_CASE(within_an_iteration_friction_turns_at_the_bound_that_was_predicted) {
  const Vector3d reference(0, 2, 0);
  for (const double bound : {-3.0, 0.0, 5.0}) {
    const FrictionTraction law = slip(reference, bound, reference, 0.8);
    BOOST_TEST((law.value == Vector3d(0, bound, 0)));
    BOOST_TEST(law.d_trial(0, 0) == 0.8 / 2);
    BOOST_TEST(law.d_trial(1, 1) == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(the_bound_at_first_touch_is_no_quotient) {
  for (const double phi : {0.0, 0.1, 1.0}) {
    const FrictionBound bound = friction_bound(rule_of(0.3, phi), 0, 0);
    BOOST_TEST(bound.value == 0.0);
    BOOST_TEST(std::isfinite(bound.d_traction));
    BOOST_TEST(std::isfinite(bound.d_pressure));
  }
}

BOOST_AUTO_TEST_CASE(derivatives_of_the_bound_match_differences) {
  // The bound is piecewise linear: away from the kink, differences are exact up to rounding divided by the step.
  const double tolerance = 100 * std::numeric_limits<double>::epsilon() / difference_step;
  std::mt19937 random(3);
  for (int sample = 0; sample < 100; ++sample) {
    const Vector3d at = random_vector(1, random);
    const FrictionRule rule = rule_of(0.4, std::abs(at[2]));
    const auto value = [&](const VectorXd& q) {
      return VectorXd::Constant(1, friction_bound(rule, q[0], q[1]).value).eval();
    };
    if (std::abs(-at[0] - (1 - rule.contact_fraction) * at[1]) < 10 * difference_step) continue;
    const FrictionBound bound = friction_bound(rule, at[0], at[1]);
    const MatrixXd approximate = differences(value, at.head<2>());
    BOOST_TEST(std::abs(approximate(0, 0) - bound.d_traction) <= tolerance);
    BOOST_TEST(std::abs(approximate(0, 1) - bound.d_pressure) <= tolerance);
  }
}

BOOST_AUTO_TEST_CASE(slip_has_the_size_of_the_bound_and_the_direction_of_the_trial) {
  std::mt19937 random(4);
  for (int sample = 0; sample < 100; ++sample) {
    const Vector3d trial = random_vector(2, random);
    const FrictionTraction law = slip(trial, 0.3);
    BOOST_TEST(std::abs(law.value.norm() - 0.3) <= rounding);
    BOOST_TEST(law.value.cross(trial).norm() <= rounding);
    BOOST_TEST(law.value.dot(trial) > 0.0);
  }
}

BOOST_AUTO_TEST_CASE(derivatives_of_stick_and_slip_match_differences) {
  std::mt19937 random(5);
  for (int sample = 0; sample < 100; ++sample) {
    const Vector3d trial = random_vector(1, random) + Vector3d(1, 1, 0);
    const auto value = [](const VectorXd& q) -> VectorXd { return slip(q.head<3>(), q[3]).value; };
    VectorXd q(4);
    q << trial, 0.7;
    const FrictionTraction law = slip(trial, 0.7);
    MatrixXd exact(3, 4);
    exact << law.d_trial, law.d_bound;
    BOOST_TEST(relative_error(differences(value, q), exact) <= difference_tolerance);
    BOOST_TEST((stick(trial).d_trial == Eigen::Matrix3d::Identity()));
    BOOST_TEST((stick(trial).value == trial));
  }
}

BOOST_AUTO_TEST_CASE(within_an_iteration_slip_agrees_to_first_order_and_does_not_turn_round) {
  std::mt19937 random(6);
  for (int sample = 0; sample < 100; ++sample) {
    const Vector3d reference = random_vector(1, random) + Vector3d(1, 1, 0);
    const FrictionTraction there = slip(reference, 0.7, reference, 0.7);
    BOOST_TEST((there.value - slip(reference, 0.7).value).norm() <= rounding);
    BOOST_TEST((there.d_trial - slip(reference, 0.7).d_trial).norm() <= rounding);
    BOOST_TEST((there.d_bound - slip(reference, 0.7).d_bound).norm() <= rounding);
    const auto value = [&](const VectorXd& q) -> VectorXd { return slip(q.head<3>(), q[3], reference, 0.6).value; };
    VectorXd q(4);
    q << reference + random_vector(0.5, random), 0.6;
    const FrictionTraction law = slip(q.head<3>(), q[3], reference, 0.6);
    MatrixXd exact(3, 4);
    exact << law.d_trial, law.d_bound;
    BOOST_TEST(relative_error(differences(value, q), exact) <= difference_tolerance);
    BOOST_TEST(std::abs(law.value.norm() - 0.6) <= rounding);
    BOOST_TEST(slip(-5 * reference, 0.7, reference, 0.7).value.dot(reference) > 0.0);
  }
}

BOOST_AUTO_TEST_CASE(what_slides_back_does_not_exceed_the_bound) {
  const Vector3d reference(0, 3, 0);
  BOOST_TEST(slip_excess(Vector3d(0, 2, 0), 0.5, reference) == 1.5);
  BOOST_TEST(slip_excess(Vector3d(9, 0.25, 0), 0.5, reference) == -0.25);
  BOOST_TEST(slip_excess(Vector3d(0, -7, 0), 0.5, reference) < 0.0);
}

BOOST_AUTO_TEST_CASE(no_trial_and_no_bound_give_no_friction) {
  const Vector3d zero(0, 0, 0);
  for (const double bound : {0.0, 0.5}) {
    const FrictionTraction law = slip(zero, bound);
    BOOST_TEST((law.value == zero));
    BOOST_TEST(law.d_trial.allFinite());
    BOOST_TEST(law.d_bound.allFinite());
  }
  const FrictionTraction free = slip(Vector3d(1, 2, 0), 0);
  BOOST_TEST((free.value == zero));
  BOOST_TEST(free.d_trial.norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(slip_dissipates_and_stick_does_not) {
  BOOST_TEST(dissipated(Vector3d(3, 4, 0), 2, 10) == 2 * (5 - 2) / 10.0);
  BOOST_TEST(dissipated(Vector3d(3, 4, 0), 5, 10) == 0.0);
  BOOST_TEST(dissipated(Vector3d(0.3, 0.4, 0), 5, 10) == 0.0);
  BOOST_TEST(dissipated(Vector3d(3, 4, 0), 0, 10) == 0.0);
  BOOST_TEST(dissipated(Vector3d(3, 4, 0), -1, 10) == 0.0);
}
