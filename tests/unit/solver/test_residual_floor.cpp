#include "fake_solver.h"
#include "solver/residual_floor.h"

#include <boost/test/unit_test.hpp>

using newton::ResidualFloor;

namespace {

constexpr double given = 1e-20;

}  // namespace

BOOST_AUTO_TEST_CASE(the_least_residual_is_that_of_rounding_until_the_step_ends) {
  FakeSolver solver;
  double rounding = 1e-15;
  ResidualFloor floor([&] { return rounding; });
  BOOST_TEST(floor.begin_step(solver));
  BOOST_TEST(solver.least_residual == 1e-15);
  rounding = 1e-16;
  floor.begin_step(solver);
  BOOST_TEST(solver.least_residual == 1e-16);
  floor.end_step(solver);
  BOOST_TEST(solver.least_residual == given);
  floor.begin_step(solver);
  floor.rewind(solver);
  BOOST_TEST(solver.least_residual == given);
}

BOOST_AUTO_TEST_CASE(one_that_a_user_gives_stays) {
  FakeSolver solver;
  solver.least_residual = 1e-22;
  ResidualFloor floor([] { return 1e-15; });
  floor.begin_step(solver);
  BOOST_TEST(solver.least_residual == 1e-22);
  floor.end_step(solver);
  BOOST_TEST(solver.least_residual == 1e-22);
}

BOOST_AUTO_TEST_CASE(a_smaller_rounding_changes_nothing) {
  FakeSolver solver;
  ResidualFloor floor([] { return 1e-25; });
  BOOST_TEST(!floor.begin_step(solver));
  BOOST_TEST(solver.least_residual == given);
}

BOOST_AUTO_TEST_CASE(a_residual_of_other_parts_than_forces_has_no_floor) {
  FakeSolver solver;
  solver.has_forces_alone = false;
  ResidualFloor floor([] { return 1.0; });
  floor.begin_step(solver);
  floor.end_step(solver);
  BOOST_TEST(solver.least_residual == given);
}
