// Tests with a fake host whose steps converge up to some factor of the penalty, and which repeats failed steps.
#include "host/contact_parameters.h"
#include "host/penalty_reduction.h"

#include <boost/test/unit_test.hpp>

#include <functional>
#include <type_traits>
#include <vector>

using mixture_contact::default_traction_factor;
using mixture_contact::PenaltyReduction;

namespace {

constexpr double step = 0.5;

class FakeHost {
 public:
  /// `bears`: largest factor of the penalty for which a step, given by its number, converges.
  explicit FakeHost(std::function<double(int)> bears) : bears_(std::move(bears)) {}

  /// Returns the factor at which each step was accepted.
  std::vector<double> run(int steps) {
    std::vector<double> factors;
    for (int n = 0; n < steps; ++n) {
      while (factor() > bears_(n) && reduction.fail(step)) ++failures;
      factors.push_back(factor());
      reduction.accept();
    }
    return factors;
  }

  double factor() const { return default_traction_factor / reduction.divisor(); }

  PenaltyReduction reduction;
  int failures = 0;

 private:
  std::function<double(int)> bears_;
};

ContactParameters automatic() { return {}; }

}  // namespace

BOOST_AUTO_TEST_CASE(penalties_are_full_where_no_step_fails) {
  FakeHost host([](int) { return 1e9; });
  for (const double factor : host.run(5)) BOOST_TEST(factor == default_traction_factor);
  BOOST_TEST(host.failures == 0);
}

BOOST_AUTO_TEST_CASE(a_failure_leaves_the_stiffness_of_the_bodies_and_accepted_steps_recover_level_by_level) {
  FakeHost host([](int n) { return n == 0 ? 1.0 : 1e9; });
  const std::vector<double> expected{1, 10, 100, 1000, 1000};
  BOOST_TEST(host.run(5) == expected, boost::test_tools::per_element());
  BOOST_TEST(host.failures == 1);
}

BOOST_AUTO_TEST_CASE(penalties_do_not_fall_below_the_stiffness_of_the_bodies) {
  PenaltyReduction reduction;
  BOOST_TEST(reduction.fail(step));
  BOOST_TEST(!reduction.fail(step));
  BOOST_TEST(default_traction_factor / reduction.divisor() == 1);
}

BOOST_AUTO_TEST_CASE(recovery_is_tried_ever_more_seldom_where_a_scene_stays_hard) {
  FakeHost host([](int) { return 100.0; });
  for (const double factor : host.run(100)) BOOST_TEST(factor <= 100);
  // Recovery is tried again after three levels of 1, 2, 4, 8 and 16 steps.
  BOOST_TEST(host.failures == 6);
}

BOOST_AUTO_TEST_CASE(a_hard_passage_that_is_over_is_forgotten) {
  FakeHost host([](int n) { return n < 20 ? 100.0 : 1e9; });
  host.run(80);
  BOOST_TEST(host.reduction.is_full());
  host.reduction.fail(step);
  for (int n = 0; n < PenaltyReduction::most_levels; ++n) host.reduction.accept();
  BOOST_TEST(host.reduction.is_full());
}

BOOST_AUTO_TEST_CASE(a_restart_continues_with_the_same_penalties) {
  FakeHost host([](int) { return 100.0; });
  host.run(8);
  std::vector<double> stored;
  host.reduction.for_each_value([&](auto& value) { stored.push_back(value); });
  FakeHost continued([](int) { return 100.0; });
  auto next = stored.begin();
  continued.reduction.for_each_value([&](auto& value) { value = static_cast<std::decay_t<decltype(value)>>(*next++); });
  BOOST_TEST(continued.run(20) == host.run(20), boost::test_tools::per_element());
  BOOST_TEST(continued.failures < host.failures);
  BOOST_TEST(continued.reduction.at(step / 4).kept == host.reduction.at(step / 4).kept);
}

BOOST_AUTO_TEST_CASE(loads_fade_over_the_longest_step_that_has_failed_since_penalties_were_full) {
  PenaltyReduction reduction;
  BOOST_TEST(reduction.at(step).divisor == 1);
  reduction.fail(step);
  reduction.fail(step / 2);
  BOOST_TEST(reduction.at(step).divisor == default_traction_factor);
  BOOST_TEST(reduction.at(step).kept == 0);
  BOOST_TEST(reduction.at(2 * step).kept == 0);
  BOOST_TEST(reduction.at(step / 4).kept == 0.75);
  for (int n = 0; n < PenaltyReduction::most_levels; ++n) reduction.accept();
  BOOST_TEST(reduction.is_full());
  reduction.fail(step / 2);
  BOOST_TEST(reduction.at(step / 4).kept == 0.5);
}

BOOST_AUTO_TEST_CASE(a_penalty_that_is_given_is_never_reduced) {
  ContactParameters given;
  given.penalties.traction = {{7, true}};
  for (const bool is_factor : {false, true}) {
    given.penalties.auto_penalty = is_factor;
    BOOST_TEST(core_settings(given, SolverKind::newton, {100}).reduced_traction.divisor == 1);
  }
}

BOOST_AUTO_TEST_CASE(automatic_penalties_are_reduced_down_to_the_stiffness_of_the_bodies) {
  BOOST_TEST(core_settings(automatic(), SolverKind::newton, {100}).reduced_traction.divisor == 100);
  ContactParameters two_pass;
  two_pass.enforcement.two_pass = true;
  BOOST_TEST(core_settings(two_pass, SolverKind::newton, {1000}).reduced_traction.divisor == 100);
  BOOST_TEST(core_settings(automatic(), SolverKind::explicit_dynamics, {10}).reduced_traction.divisor == 1);
}

BOOST_AUTO_TEST_CASE(unknown_multipliers_have_no_penalty_to_reduce) {
  ContactParameters multipliers;
  multipliers.enforcement.laugon = 2;
  BOOST_TEST(core_settings(multipliers, SolverKind::newton, {10}).reduced_traction.divisor == 1);
}
