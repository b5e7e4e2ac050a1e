#include "newton/zero_unknowns.h"

#include "random_contact.h"

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>

using newton::ZeroUnknowns;

namespace {

constexpr int size = 7;

/// A matrix that is far from singular, however its rows and columns are left out, and what is asked of its inverse.
struct System {
  explicit System(unsigned seed) {
    std::mt19937 random(seed);
    matrix = test::random_values(size * size, -1, 1, random).reshaped(size, size);
    matrix += size * Eigen::MatrixXd::Identity(size, size);
  }
  std::vector<double> solve(const std::vector<double>& right) {
    ++solutions;
    const Eigen::VectorXd x = matrix.partialPivLu().solve(Eigen::Map<const Eigen::VectorXd>(right.data(), size));
    return {x.data(), x.data() + size};
  }
  ZeroUnknowns::Solve solver() {
    return [this](const std::vector<double>& right) { return solve(right); };
  }

  Eigen::MatrixXd matrix;
  int solutions = 0;
};

const std::vector<double> load{1, -2, 3, 0.5, -1, 2, 4};

}  // namespace

BOOST_AUTO_TEST_CASE(unknowns_are_held_at_zero_as_if_the_matrix_had_neither_their_rows_nor_their_columns) {
  System system(3);
  ZeroUnknowns zero;
  const std::vector<int> held{1, 4, 5};
  std::vector<double> right = load;
  BOOST_TEST(zero.hold(system.solver(), held, right));
  const std::vector<double> x = system.solve(right);
  Eigen::MatrixXd without = system.matrix;
  Eigen::VectorXd values = Eigen::Map<const Eigen::VectorXd>(load.data(), size);
  for (const int i : held) {
    without.row(i).setZero();
    without.col(i).setZero();
    without(i, i) = 1;
    values[i] = 0;
  }
  const Eigen::VectorXd expected = without.partialPivLu().solve(values);
  BOOST_TEST((Eigen::Map<const Eigen::VectorXd>(x.data(), size) - expected).norm() < test::rounding * expected.norm());
}

BOOST_AUTO_TEST_CASE(each_unknown_costs_a_solution_once_until_there_is_another_matrix) {
  System system(5);
  ZeroUnknowns zero;
  std::vector<double> right = load;
  zero.hold(system.solver(), {0, 2}, right);
  BOOST_TEST(system.solutions == 3);
  zero.hold(system.solver(), {0, 2, 3}, right);
  BOOST_TEST(system.solutions == 5);
  zero.forget();
  zero.hold(system.solver(), {0}, right);
  BOOST_TEST(system.solutions == 7);
}

BOOST_AUTO_TEST_CASE(nothing_that_is_held_costs_nothing) {
  System system(7);
  std::vector<double> right = load;
  BOOST_TEST(ZeroUnknowns().hold(system.solver(), {}, right));
  BOOST_TEST((right == load));
  BOOST_TEST(system.solutions == 0);
}

BOOST_AUTO_TEST_CASE(a_matrix_that_is_singular_without_them_holds_none) {
  System system(9);
  system.matrix = Eigen::MatrixXd::Identity(size, size);
  system.matrix.topLeftCorner(2, 2) << 0, 1, 1, 0;  // the first unknown stands in the second equation alone
  std::vector<double> right = load;
  BOOST_TEST(!ZeroUnknowns().hold(system.solver(), {0}, right));
  BOOST_TEST((right == load));
}
