#include "contact/conditions/multiplier.h"
#include "contact/conditions/normal.h"

#include <boost/test/unit_test.hpp>

#include <array>

using namespace mixture_contact;

// All numbers in these tests are sums of powers of two, for which every operation is exact.

namespace {

constexpr double penalty = 4;

/// The normal traction of a node that begins with a gap.
LawValue unilateral(double lambda, double gap, double touch = 0) {
  const LawValue trial = augmented(lambda, penalty, gap);
  return NormalCondition::load(trial, Unilateral().begins(trial, touch));
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_augmented_load_is_linear_in_gap_or_jump_of_either_sign) {
  for (const double jump : {-2.0, 0.0, 0.5}) {
    const LawValue law = augmented(0.25, 8, jump);
    BOOST_TEST(law.value == 0.25 + 8 * jump);
    BOOST_TEST(law.derivative == 8.0);
  }
}

BOOST_AUTO_TEST_CASE(traction_is_the_multiplier_plus_penalty_times_overlap) {
  BOOST_TEST(unilateral(-0.5, -0.25).value == -1.5);
  BOOST_TEST(unilateral(-0.5, -0.25).derivative == penalty);
}

BOOST_AUTO_TEST_CASE(traction_never_pulls) {
  for (const double gap : {0.125, 1.0, 1024.0}) {
    BOOST_TEST(unilateral(0, gap).value == 0.0);
    BOOST_TEST(unilateral(0, gap).derivative == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(a_bilateral_condition_pulls) {
  for (const double gap : {-0.25, 0.25, 1024.0}) {
    const LawValue trial = augmented(-0.5, penalty, gap);
    BOOST_TEST(Bilateral().begins(trial, 0));
    BOOST_TEST(NormalCondition::load(trial, true).value == -0.5 + penalty * gap);
    BOOST_TEST(NormalCondition::load(trial, true).derivative == penalty);
  }
}

BOOST_AUTO_TEST_CASE(a_multiplier_moves_the_lift_off_to_its_own_gap) {
  BOOST_TEST(unilateral(-1, 0.1875).value == -0.25);
  BOOST_TEST(unilateral(-1, 0.25).value == 0.0);
  BOOST_TEST(unilateral(-1, 0.25).derivative == penalty);
  BOOST_TEST(unilateral(-1, 0.3125).value == 0.0);
  BOOST_TEST(unilateral(-1, 0.3125).derivative == 0.0);
}

BOOST_AUTO_TEST_CASE(surfaces_that_touch_are_in_contact) {
  constexpr double touch = 0.0078125;
  for (const double gap : {-touch, 0.0, 0.5 * touch, touch})
    BOOST_TEST(unilateral(0, gap, touch).derivative == penalty);
  BOOST_TEST(unilateral(0, 2 * touch, touch).derivative == 0.0);
  BOOST_TEST(unilateral(0, -touch, touch).value == -penalty * touch);
}

BOOST_AUTO_TEST_CASE(without_a_penalty_nothing_touches) {
  BOOST_TEST(!Unilateral().begins(augmented(0, 0, -1), 0));
  BOOST_TEST(!Bilateral().begins(augmented(0, 0, -1), 0));
}

BOOST_AUTO_TEST_CASE(a_unilateral_condition_opens_under_tension_and_closes_under_overlap) {
  const Unilateral condition;
  constexpr double least = 0.125;
  BOOST_TEST(condition.stays(-1, least));
  BOOST_TEST(condition.stays(least, least));
  BOOST_TEST(!condition.stays(2 * least, least));
  BOOST_TEST(condition.closes(-2 * least, least));
  BOOST_TEST(!condition.closes(-least, least));
  BOOST_TEST(condition.may_part());
}

BOOST_AUTO_TEST_CASE(a_bilateral_condition_holds_whatever_the_load) {
  const Bilateral condition;
  for (const double load : {-1.0, 0.0, 1.0}) {
    BOOST_TEST(condition.stays(load, 0));
    BOOST_TEST(condition.closes(load, 0));
    BOOST_TEST(condition.admissible(load) == load);
    BOOST_TEST(condition.residual_gap(0.5, load) == 0.5);
  }
  BOOST_TEST(!condition.may_part());
}

BOOST_AUTO_TEST_CASE(admissible_tractions_are_compressive) {
  BOOST_TEST(Unilateral().admissible(-2) == -2.0);
  BOOST_TEST(Unilateral().admissible(2) == 0.0);
}

BOOST_AUTO_TEST_CASE(surfaces_that_touch_without_load_leave_no_gap) {
  BOOST_TEST(Unilateral().residual_gap(0.5, -1) == 0.5);
  BOOST_TEST(Unilateral().residual_gap(0.5, 0) == 0.0);
}

BOOST_AUTO_TEST_CASE(the_choice_of_gaps_has_its_condition) {
  BOOST_TEST(normal_condition({0, false, true}).may_part());
  BOOST_TEST(!normal_condition({0, true, true}).may_part());
  for (const bool both_ways : {false, true}) {
    const double one = Unilateral().penalty_factor(both_ways);
    BOOST_TEST(one == (both_ways ? two_pass_traction_factor : default_traction_factor));
    BOOST_TEST(Bilateral().penalty_factor(both_ways) == std::min(one, tension_traction_factor));
  }
}
