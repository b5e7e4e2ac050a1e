#include "contact/law/laws.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace mixture_contact;

// All numbers here are sums of powers of two, so that every operation is exact.

BOOST_AUTO_TEST_CASE(traction_is_the_multiplier_plus_penalty_times_overlap) {
  const LawValue law = normal_traction(-0.5, 4, -0.25, 0);
  BOOST_TEST(law.value == -1.5);
  BOOST_TEST(law.derivative == 4.0);
}

BOOST_AUTO_TEST_CASE(traction_never_pulls) {
  for (const double gap : {0.125, 1.0, 1024.0}) {
    const LawValue law = normal_traction(0, 4, gap, 0);
    BOOST_TEST(law.value == 0.0);
    BOOST_TEST(law.derivative == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(two_sided_traction_pulls) {
  BOOST_TEST(two_sided_traction(-0.5, 4, 0.25).value == 0.5);
  BOOST_TEST(two_sided_traction(-0.5, 4, -0.25).value == -1.5);
  BOOST_TEST(two_sided_traction(-0.5, 4, 0.25).derivative == 4.0);
}

BOOST_AUTO_TEST_CASE(a_multiplier_moves_the_lift_off_to_its_own_gap) {
  BOOST_TEST(normal_traction(-1, 4, 0.1875, 0).value == -0.25);
  BOOST_TEST(normal_traction(-1, 4, 0.25, 0).value == 0.0);
  BOOST_TEST(normal_traction(-1, 4, 0.25, 0).derivative == 4.0);
  BOOST_TEST(normal_traction(-1, 4, 0.3125, 0).value == 0.0);
  BOOST_TEST(normal_traction(-1, 4, 0.3125, 0).derivative == 0.0);
}

BOOST_AUTO_TEST_CASE(surfaces_that_touch_have_the_slope_of_contact_and_no_load) {
  constexpr double touch = 0.0078125;
  for (const double gap : {0.0, 0.5 * touch, touch}) {
    const LawValue law = normal_traction(0, 4, gap, touch);
    BOOST_TEST(law.value == 0.0);
    BOOST_TEST(law.derivative == 4.0);
  }
  BOOST_TEST(normal_traction(0, 4, 2 * touch, touch).derivative == 0.0);
  BOOST_TEST(normal_traction(0, 4, -touch, touch).value == -4 * touch);
}

BOOST_AUTO_TEST_CASE(flux_is_linear_in_the_jump_of_either_sign) {
  for (const double jump : {-2.0, 0.0, 0.5}) {
    const LawValue law = normal_flux(0.25, 8, jump);
    BOOST_TEST(law.value == 0.25 + 8 * jump);
    BOOST_TEST(law.derivative == 8.0);
  }
}
