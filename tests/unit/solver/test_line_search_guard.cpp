#include "fake_solver.h"
#include "solver/line_search_guard.h"

#include <boost/test/unit_test.hpp>

using newton::LineSearchGuard;

namespace {

/// A step whose last increment the line search has shortened to a fraction.
struct Searched {
  explicit Searched(double part) {
    guard.begin_step(solver);
    solver.increment = {1, 0};
    guard.try_increment(solver, {part, 0});
  }

  FakeSolver solver;
  LineSearchGuard guard;
};

}  // namespace

BOOST_AUTO_TEST_CASE(an_increment_that_was_shortened_little_is_accepted) {
  Searched step(0.6);
  BOOST_TEST(!step.guard.rejects(step.solver));
  BOOST_TEST(step.solver.tolerance == 0.9);
  BOOST_TEST(step.solver.lines.empty());
}

BOOST_AUTO_TEST_CASE(after_one_that_was_cut_the_next_is_taken_as_a_whole_and_the_log_says_so) {
  Searched step(0.4);
  BOOST_TEST(step.guard.rejects(step.solver));
  BOOST_TEST(step.solver.tolerance == 0);
  BOOST_TEST(step.solver.lines.size() == 1);
  BOOST_TEST(step.solver.lines[0].find("line_search_guard") == 0);
  step.guard.try_increment(step.solver, {1, 0});
  BOOST_TEST(step.solver.tolerance == 0.9);
}

BOOST_AUTO_TEST_CASE(it_acts_once_in_a_step) {
  Searched step(0.4);
  BOOST_TEST(step.guard.rejects(step.solver));
  step.guard.try_increment(step.solver, {0.4, 0});
  BOOST_TEST(!step.guard.rejects(step.solver));
  step.guard.begin_step(step.solver);
  step.guard.try_increment(step.solver, {0.4, 0});
  BOOST_TEST(step.guard.rejects(step.solver));
}

BOOST_AUTO_TEST_CASE(a_state_whose_residual_is_rounding_is_accepted) {
  Searched step(0.4);
  step.solver.squares = {1e-17, 1};
  BOOST_TEST(!step.guard.rejects(step.solver));
  step.solver.squares = {0, 0};
  BOOST_TEST(!step.guard.rejects(step.solver));
  step.solver.squares = {1e-12, 1};
  BOOST_TEST(step.guard.rejects(step.solver));
}

BOOST_AUTO_TEST_CASE(a_failed_attempt_leaves_the_search_as_it_was) {
  Searched step(0.4);
  step.guard.rejects(step.solver);
  step.guard.begin_step(step.solver);
  BOOST_TEST(step.solver.tolerance == 0.9);
}

BOOST_AUTO_TEST_CASE(without_a_line_search_there_is_nothing_to_guard) {
  Searched without_tolerance(0.4);
  without_tolerance.solver.tolerance = 0;
  BOOST_TEST(!without_tolerance.guard.rejects(without_tolerance.solver));
  Searched without_search(0.4);
  without_search.solver.searches = false;
  BOOST_TEST(!without_search.guard.rejects(without_search.solver));
}
