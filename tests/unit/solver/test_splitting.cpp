#include "solver/splitting.h"

#include "random_contact.h"

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>

#include <limits>

using newton::MatrixPart;
using newton::Split;

namespace {

constexpr int size = 6;
const std::vector<double> load{1, -2, 3, 0.5, -1, 2};

Eigen::VectorXd vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), indexing::number_of(values));
}

std::vector<int> all_equations() { return {0, 1, 2, 3, 4, 5}; }

/// A part that rotates a vector and multiplies its length by `factor`: with the unit matrix as K, each iteration
/// reduces the error exactly by this factor.
Eigen::MatrixXd turn(double factor) {
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(size, size);
  for (int n = 0; n < size; n += 2) {
    values(n, n + 1) = factor;
    values(n + 1, n) = -factor;
  }
  return values;
}

MatrixPart part_of(const Eigen::MatrixXd& values) {
  MatrixPart part;
  part.add({all_equations(), all_equations(), values});
  return part;
}

/// The unit matrix as K, with a count of its solutions.
struct UnitMatrix {
  newton::Solve solver() {
    return [this](const std::vector<double>& right) {
      ++solutions;
      return right;
    };
  }
  int solutions = 0;
};

/// The result of the last iteration for a split right-hand side with the unit matrix.
Eigen::VectorXd last_sweep(const Split& split) { return vector(load) - vector(split.product); }

}  // namespace

BOOST_AUTO_TEST_CASE(the_sweep_that_is_left_to_the_caller_meets_the_tolerance) {
  for (const double factor : {0.01, 0.1, 0.3, 0.45}) {
    for (const double tolerance : {1e-1, 1e-3, 1e-6}) {
      const Eigen::MatrixXd values = turn(factor);
      const MatrixPart part = part_of(values);
      UnitMatrix unit;
      const Split split = newton::split(unit.solver(), {&part}, load, tolerance);
      BOOST_TEST(split.converges);
      const Eigen::VectorXd
          expected = (Eigen::MatrixXd::Identity(size, size) + values).partialPivLu().solve(vector(load));
      // After k iterations the change is factor^k |b|, with |b| >= |x|, and the last iteration leaves the error
      // factor^(k+2) |x|. This is at most `factor` times the change, which is within the tolerance of |x_k| <= (1 +
      // factor) |x|.
      BOOST_TEST((last_sweep(split) - expected).norm() <= (tolerance + test::rounding) * expected.norm());
    }
  }
}

BOOST_AUTO_TEST_CASE(a_small_part_costs_two_solutions) {
  const MatrixPart part = part_of(turn(0.01));
  UnitMatrix unit;
  newton::split(unit.solver(), {&part}, load, 1e-2);
  BOOST_TEST(unit.solutions == 2);
}

BOOST_AUTO_TEST_CASE(a_part_that_is_known_to_be_small_costs_one_solution) {
  constexpr double tolerance = 1e-2;
  for (const double factor : {0.03, 0.3}) {
    const Eigen::MatrixXd values = turn(factor);
    const MatrixPart part = part_of(values);
    UnitMatrix unit;
    const Split split = newton::split(unit.solver(), {&part}, load, tolerance, {factor, tolerance});
    BOOST_TEST((unit.solutions == 1) == (factor < 0.1));
    const Eigen::VectorXd solution = last_sweep(split);
    const Eigen::VectorXd
        expected = (Eigen::MatrixXd::Identity(size, size) + values).partialPivLu().solve(vector(load));
    BOOST_TEST((solution - expected).norm() <= tolerance * expected.norm());
    const double seen = newton::seen_reduction(split, {&part}, {solution.data(), solution.data() + size});
    // The reduction is the difference of two solutions divided by the change, each with the rounding error of parts of
    // the load.
    const double rounded = test::rounding * vector(load).norm() / (factor * split.change);
    BOOST_TEST(seen == factor, boost::test_tools::tolerance(rounded));
  }
}

BOOST_AUTO_TEST_CASE(a_reduction_that_cannot_be_seen_is_unknown) {
  const MatrixPart part = part_of(turn(0.1));
  UnitMatrix unit;
  const Split split = newton::split(unit.solver(), {&part}, load, 1e-2);
  const std::vector<double> broken(size, std::numeric_limits<double>::quiet_NaN());
  BOOST_TEST(newton::seen_reduction(split, {&part}, broken) == newton::unknown_reduction);
  const std::vector<double> zero(size);
  const Split at_rest = newton::split(unit.solver(), {&part}, zero, 1e-2, {0.01, 1e-2});
  BOOST_TEST(newton::seen_reduction(at_rest, {&part}, zero) == newton::unknown_reduction);
}

BOOST_AUTO_TEST_CASE(another_right_hand_side_costs_no_sweep_where_its_solution_is_near) {
  constexpr double tolerance = 1e-2;
  constexpr double factor = 0.3;
  const Eigen::MatrixXd values = turn(factor);
  const MatrixPart part = part_of(values);
  UnitMatrix unit;
  const Split last = newton::split(unit.solver(), {&part}, load, tolerance);
  for (const double change : {0.03, 0.3}) {  // below and above tolerance/factor^2 = 0.11
    const Eigen::VectorXd right = vector(load) + change * Eigen::VectorXd::Unit(size, 3) * vector(load).norm();
    const Eigen::VectorXd x = right - vector(last.product);
    unit.solutions = 0;
    const Split split = newton::split_near(last, {x.data(), x.data() + size}, unit.solver(), {&part},
                                           {right.data(), right.data() + size}, tolerance);
    BOOST_TEST(split.converges);
    BOOST_TEST((unit.solutions == 0) == (change < 0.1));
    const Eigen::VectorXd expected = (Eigen::MatrixXd::Identity(size, size) + values).partialPivLu().solve(right);
    BOOST_TEST((right - vector(split.product) - expected).norm() <= tolerance * expected.norm());
  }
}

BOOST_AUTO_TEST_CASE(the_solution_with_a_large_part_is_found_without_convergence_of_the_sweeps) {
  constexpr double tolerance = 1e-2;
  Eigen::MatrixXd growing = Eigen::MatrixXd::Zero(size, size);  // the change grows in the second iteration
  growing(1, 0) = 0.4;
  growing(0, 1) = 2;
  Eigen::MatrixXd nearly_singular = turn(0.1);
  nearly_singular(4, 4) = -0.999;
  for (const Eigen::MatrixXd& values : {turn(0.7), turn(3), growing, nearly_singular}) {
    const MatrixPart part = part_of(values);
    UnitMatrix unit;
    const Split split = newton::split(unit.solver(), {&part}, load, tolerance);
    BOOST_TEST(!split.converges);
    BOOST_TEST(unit.solutions <= size + 3);  // a Krylov space has at most `size` dimensions
    const Eigen::VectorXd solution = last_sweep(split);
    // The last sweep turns x with the residual r into x + r, whose residual is -D r, with |r| <= tolerance |x|.
    const double most = values.norm() * tolerance / (1 - tolerance);
    BOOST_TEST((vector(load) - solution - values * solution).norm() <= most * solution.norm());
  }
}

BOOST_AUTO_TEST_CASE(what_is_no_number_says_nothing_of_a_part) {
  const MatrixPart part = part_of(turn(0.1));
  UnitMatrix unit;
  const std::vector<double> broken(size, std::numeric_limits<double>::quiet_NaN());
  const Split split = newton::split(unit.solver(), {&part}, broken, 1e-2);
  BOOST_TEST(split.converges);
  BOOST_TEST(split.product.empty());
}

BOOST_AUTO_TEST_CASE(no_part_costs_nothing) {
  const MatrixPart none;
  UnitMatrix unit;
  const Split split = newton::split(unit.solver(), {&none}, load, 1e-2);
  BOOST_TEST(split.converges);
  BOOST_TEST(split.product.empty());
  BOOST_TEST(unit.solutions == 0);
}

BOOST_AUTO_TEST_CASE(blocks_of_all_parts_add_up_where_they_have_equations) {
  std::mt19937 random(5);
  const Eigen::MatrixXd values = test::random_values(6, -1, 1, random).reshaped(2, 3);
  MatrixPart one;
  one.add({{4, -1}, {0, -1, 2}, values});
  one.add({{4, 1}, {0, 5, 2}, values});
  MatrixPart other;
  other.add({{1, 3}, {2, 3, 4}, values});
  std::vector<double> sum(size);
  for (const MatrixPart* part : {&one, &other}) part->add_product(load, sum);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
  for (const auto& [i, row] : std::vector<std::pair<int, int>>{{0, 4}, {1, 1}}) {
    for (const auto& [j, column] : std::vector<std::pair<int, int>>{{0, 0}, {1, 5}, {2, 2}})
      dense(row, column) += values(i, j);
  }
  dense(4, 0) += values(0, 0);
  dense(4, 2) += values(0, 2);
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 3; ++j) dense(1 + 2 * i, 2 + j) += values(i, j);
  }
  BOOST_TEST((vector(sum) - dense * vector(load)).norm() < test::rounding * vector(load).norm());
  BOOST_TEST(one.squares(load) == 2 * load[0] * load[0] + 2 * load[2] * load[2] + load[5] * load[5]);
}
