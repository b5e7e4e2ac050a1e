#include "fake_solver.h"
#include "solver/held_values.h"
#include "solver/non_negative_concentrations.h"

#include <boost/test/unit_test.hpp>

using newton::NonNegativeConcentrations;
using newton::Place;

namespace {

constexpr Place first{0, 1};   // concentration of node 0: equation 1
constexpr Place second{1, 1};  // concentration of node 1: equation 3

/// A model with -0.1 at node 0 in the solver's vectors, and 1 at node 1.
class Undershoot : public FakeSolver {
 public:
  Undershoot() : FakeSolver(2) {
    clamps = true;
    begin_step();
    change = {0, -0.1, 0, 1};
    std::vector<double> none(4, 0.0);
    update(none);
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(nothing_happens_where_the_solver_clamps_nothing) {
  Undershoot solver;
  solver.clamps = false;
  NonNegativeConcentrations helper;
  BOOST_TEST(helper.is_settled(solver));
  BOOST_TEST(!helper.adapt(solver));
  BOOST_TEST(solver.equation(first) == 1);
  BOOST_TEST(solver.lines.empty());
}

BOOST_AUTO_TEST_CASE(a_negative_concentration_is_held_at_zero_and_the_log_says_so_once) {
  Undershoot solver;
  NonNegativeConcentrations helper;
  BOOST_TEST(!helper.is_settled(solver));
  BOOST_TEST(helper.adapt(solver));
  BOOST_TEST(solver.equation(first) == newton::prescribed(1));
  BOOST_TEST(solver.value(first) == 0);
  BOOST_TEST(helper.holds(first));
  BOOST_TEST(!helper.holds(second));
  BOOST_TEST(helper.is_settled(solver));
  solver.change[3] = -1;
  BOOST_TEST(helper.adapt(solver));
  BOOST_TEST(solver.lines.size() == 1);
  BOOST_TEST(solver.lines[0].find("non_negative_concentrations") == 0);
}

BOOST_AUTO_TEST_CASE(an_undershoot_of_rounding_does_not_count) {
  Undershoot solver;
  solver.change[1] = -1e-7;
  NonNegativeConcentrations helper;
  BOOST_TEST(helper.is_settled(solver));
  BOOST_TEST(!helper.adapt(solver));
}

BOOST_AUTO_TEST_CASE(a_held_one_is_freed_once_a_step_where_its_balance_wants_it_positive) {
  Undershoot solver;
  NonNegativeConcentrations helper;
  helper.adapt(solver);
  solver.reactions[1] = 1;
  BOOST_TEST(!helper.is_settled(solver));
  BOOST_TEST(helper.adapt(solver));
  BOOST_TEST(solver.equation(first) == 1);
  // The vectors contain the nodal value, such that the next update does not restore the undershoot.
  BOOST_TEST(solver.total[1] + solver.change[1] == 0);
  solver.change[1] -= 0.2;
  BOOST_TEST(helper.adapt(solver));
  BOOST_TEST(helper.is_settled(solver));  // prescribed again, and not freed a second time
}

BOOST_AUTO_TEST_CASE(a_reaction_that_draws_down_frees_nothing) {
  Undershoot solver;
  NonNegativeConcentrations helper;
  helper.adapt(solver);
  solver.reactions[1] = -1;
  BOOST_TEST(helper.is_settled(solver));
}

BOOST_AUTO_TEST_CASE(reactions_are_evaluated_where_the_solver_has_not) {
  Undershoot solver;
  NonNegativeConcentrations helper;
  helper.adapt_before_residual(solver);
  BOOST_TEST(solver.evaluations == 0);  // no concentration was prescribed
  helper.adapt_before_residual(solver);
  BOOST_TEST(solver.evaluations == 1);
}

BOOST_AUTO_TEST_CASE(between_steps_nothing_is_held_and_the_next_one_resumes) {
  Undershoot solver;
  NonNegativeConcentrations helper;
  helper.adapt(solver);
  for (std::size_t n = 0; n < 4; ++n) solver.total[n] += solver.change[n];
  helper.end_step(solver);
  BOOST_TEST(solver.equation(first) == 1);
  BOOST_TEST(solver.total[1] == 0);
  BOOST_TEST(!helper.holds(first));
  solver.begin_step();
  helper.begin_iterations(solver);
  BOOST_TEST(helper.holds(first));
  solver.set_value(first, 0.5);  // another object has set it
  helper.begin_iterations(solver);
  BOOST_TEST(solver.equation(first) == 1);
}

BOOST_AUTO_TEST_CASE(after_a_cutback_the_vectors_are_those_of_the_start) {
  Undershoot solver;
  NonNegativeConcentrations helper;
  helper.adapt(solver);
  solver.reactions[1] = 1;
  helper.adapt(solver);  // frees the concentration and sets the vectors
  solver.begin_step();
  solver.set_value(first, 0.25);
  helper.begin_iterations(solver);
  BOOST_TEST(solver.total[1] == 0.25);
}

BOOST_AUTO_TEST_CASE(a_value_can_be_left_to_somebody_else) {
  Undershoot solver;
  newton::Helpers helpers(solver);
  newton::DeviceRecord record;
  helpers.add(
      newton::Device::non_negative_concentrations, std::make_unique<NonNegativeConcentrations>(), [] { return true; },
      record);
  helpers.adapt();
  BOOST_TEST(helpers.keeps(first, true));
  BOOST_TEST(!helpers.keeps(second, true));
  BOOST_TEST(!helpers.keeps(first, false));
  BOOST_TEST(!helpers.keeps(first, true));
  BOOST_TEST(solver.equation(first) == newton::prescribed(1));  // unchanged
  BOOST_TEST(record.summary().find("non_negative_concentrations 1") != std::string::npos);
  BOOST_CHECK_THROW(helpers.unavailable(newton::Device::predictor), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(a_helper_that_is_switched_off_lets_go_where_iterations_begin) {
  Undershoot solver;
  newton::Helpers helpers(solver);
  newton::DeviceRecord record;
  helpers.add(
      newton::Device::non_negative_concentrations, std::make_unique<NonNegativeConcentrations>(),
      [&] { return !record.is_suspended(); }, record);
  helpers.adapt();
  BOOST_TEST(newton::is_prescribed(solver.equation(first)));
  record.suspend();
  helpers.begin_iterations();
  BOOST_TEST(solver.equation(first) == 1);
  BOOST_TEST(!helpers.adapt());
}

BOOST_AUTO_TEST_CASE(a_helper_that_is_off_and_a_solver_that_is_not_newtons_do_nothing) {
  for (const bool on : {false, true}) {
    Undershoot solver;
    solver.newton = !on;
    newton::Helpers helpers(solver);
    newton::DeviceRecord record;
    helpers.add(
        newton::Device::non_negative_concentrations, std::make_unique<NonNegativeConcentrations>(), [on] { return on; },
        record);
    BOOST_TEST(helpers.are_settled());
    BOOST_TEST(!helpers.adapt());
    BOOST_TEST(solver.equation(first) == 1);
  }
}
