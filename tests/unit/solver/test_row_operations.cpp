/// Tests that row operations do not change solutions if they are applied to right-hand sides as well.
#include "solver/row_operations.h"

#include "surfaces.h"

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>
#include <vector>

using newton::RowOperations;

namespace {

Eigen::VectorXd vector(const std::vector<double>& entries) {
  return Eigen::Map<const Eigen::VectorXd>(entries.data(), static_cast<Eigen::Index>(entries.size()));
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_solution_is_that_of_the_matrix_without_them) {
  const std::vector<double> right{1, -2, 3, 0.5};
  const RowOperations operations{{1, {{0, 2.5}, {3, -1.5}}}, {2, {{0, 4}}}};
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(4, 4);
  Eigen::MatrixXd changed = matrix;
  changed.row(1) += 2.5 * matrix.row(0) - 1.5 * matrix.row(3);
  changed.row(2) += 4 * matrix.row(0);
  const Eigen::VectorXd expected = matrix.lu().solve(vector(right));
  const Eigen::VectorXd solution = changed.lu().solve(vector(newton::applied(operations, right)));
  const double bound = test::rounding / changed.lu().rcond();
  BOOST_TEST((solution - expected).norm() < bound * expected.norm());
}

BOOST_AUTO_TEST_CASE(a_row_takes_multiples_of_others) {
  BOOST_TEST((newton::applied({{1, {{0, 2}, {2, -1}}}}, {3, 10, 4}) == std::vector<double>{3, 12, 4}));
  BOOST_TEST((newton::applied({}, {3, 10}) == std::vector<double>{3, 10}));
}
