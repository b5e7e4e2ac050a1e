#include "fake_solver.h"
#include "solver/search_after_failure.h"

#include <boost/test/unit_test.hpp>

namespace {

/// A solver whose user has set this tolerance of the line search, with the helper.
struct Repeated {
  explicit Repeated(double given) { solver.tolerance = given; }

  FakeSolver solver;
  bool is_needed = true;
  newton::DeviceRecord record;
  newton::SearchAfterFailure helper{[this] { return is_needed; }, record};
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_repeated_attempt_has_a_line_search_until_the_step_is_solved) {
  for (const double given : {0.0, 0.5}) {
    Repeated step(given);
    step.helper.rewind(step.solver);
    step.is_needed = false;
    step.helper.rewind(step.solver);
    BOOST_TEST(step.solver.tolerance == (given == 0 ? 0.9 : given));
    BOOST_TEST(step.solver.halves_inversions);
    step.helper.end_step(step.solver);
    BOOST_TEST(step.solver.tolerance == given);
    BOOST_TEST(!step.solver.halves_inversions);
  }
}

BOOST_AUTO_TEST_CASE(other_failures_change_nothing) {
  Repeated step(0);
  step.is_needed = false;
  step.helper.rewind(step.solver);
  BOOST_TEST(step.solver.tolerance == 0);
  BOOST_TEST(!step.solver.halves_inversions);
}

BOOST_AUTO_TEST_CASE(a_solver_without_a_line_search_is_left_alone) {
  Repeated step(0);
  step.solver.searches = false;
  step.helper.rewind(step.solver);
  step.helper.end_step(step.solver);
  BOOST_TEST(step.solver.tolerance == 0);
}
