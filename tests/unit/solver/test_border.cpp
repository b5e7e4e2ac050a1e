#include "solver/border.h"

#include "random_contact.h"

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>

#include <cmath>

using newton::Border;
using newton::Condition;

namespace {

constexpr int size = 7;

/// A matrix that is far from singular for any removed rows and columns, with a count of its solutions.
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
  newton::SolveAll solver() {
    return [this](const Eigen::MatrixXd& rights) -> Eigen::MatrixXd {
      ++calls;
      solutions += indexing::as_int(rights.cols());
      return matrix.partialPivLu().solve(rights);
    };
  }

  Eigen::MatrixXd matrix;
  int solutions = 0;
  int calls = 0;
};

const std::vector<double> load{1, -2, 3, 0.5, -1, 2, 4};

std::vector<Condition> zeros(const std::vector<int>& equations) {
  std::vector<Condition> conditions;
  for (const int equation : equations) conditions.push_back(newton::given_unknown(equation, 0));
  return conditions;
}

std::vector<int> all_equations() { return {6, 5, 4, -1, 3, 2, 2, 1, 0}; }

Eigen::VectorXd vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), indexing::number_of(values));
}

}  // namespace

BOOST_AUTO_TEST_CASE(unknowns_are_held_at_zero_as_if_the_matrix_had_neither_their_rows_nor_their_columns) {
  System system(3);
  Border border(all_equations);
  const std::vector<int> held{1, 4, 5};
  std::vector<double> right = load;
  BOOST_TEST(border.hold(system.solver(), zeros(held), system.solve(right), right));
  const std::vector<double> x = system.solve(right);
  Eigen::MatrixXd without = system.matrix;
  Eigen::VectorXd values = vector(load);
  for (const int i : held) {
    without.row(i).setZero();
    without.col(i).setZero();
    without(i, i) = 1;
    values[i] = 0;
  }
  const Eigen::VectorXd expected = without.partialPivLu().solve(values);
  BOOST_TEST((vector(x) - expected).norm() < test::rounding * expected.norm());
}

BOOST_AUTO_TEST_CASE(conditions_are_held_as_if_the_matrix_had_their_rows_and_columns_whatever_their_units) {
  System system(4);
  std::mt19937 random(6);
  std::vector<Condition> conditions = zeros({2});
  for (const double unit : {1.0, 1e18}) {
    Condition condition{size + indexing::number_of(conditions), {}, {}, -0.5 * unit, 0};
    for (int i = 0; i < size; i += 2) {
      condition.column.push_back({i, unit * test::random_values(1, -1, 1, random)[0]});
      condition.row.push_back({i, test::random_values(1, -1, 1, random)[0]});
    }
    conditions.push_back(condition);
  }
  Eigen::MatrixXd bordered = Eigen::MatrixXd::Zero(size + 3, size + 3);
  bordered.topLeftCorner(size, size) = system.matrix;
  for (int n = 0; n < 3; ++n) {
    for (const auto& [i, value] : indexing::at(conditions, n).column) bordered(i, size + n) = value;
    for (const auto& [i, value] : indexing::at(conditions, n).row) bordered(size + n, i) = value;
    bordered(size + n, size + n) = indexing::at(conditions, n).diagonal;
  }
  Eigen::VectorXd values = Eigen::VectorXd::Zero(size + 3);
  values.head(size) = vector(load);
  const Eigen::VectorXd expected = bordered.partialPivLu().solve(values).head(size);
  std::vector<double> right = load;
  BOOST_TEST(Border(all_equations).hold(system.solver(), conditions, system.solve(right), right));
  BOOST_TEST((vector(system.solve(right)) - expected).norm() < test::rounding * expected.norm());
}

BOOST_AUTO_TEST_CASE(each_condition_costs_a_solution_once_until_there_is_another_matrix) {
  System system(5);
  Border border(all_equations);
  const std::vector<double> free = system.solve(load);
  std::vector<double> right = load;
  border.hold(system.solver(), zeros({0, 2}), free, right);
  BOOST_TEST(system.solutions == 3);
  BOOST_TEST(system.calls == 1);
  border.hold(system.solver(), zeros({0, 2, 3}), free, right);
  BOOST_TEST(system.solutions == 4);
  border.forget();
  border.hold(system.solver(), zeros({0}), free, right);
  BOOST_TEST(system.solutions == 5);
}

BOOST_AUTO_TEST_CASE(many_conditions_are_solved_for_in_batches) {
  System system(13);
  std::vector<Condition> conditions;
  for (int key = 0; key < 70; ++key) conditions.push_back({size + key, {{key % size, 1.0}}, {}, 1, 0.1 * key});
  const auto answer = Border(all_equations).answer(system.solver(), conditions, system.solve(load));
  BOOST_REQUIRE(answer.has_value());
  BOOST_TEST(system.solutions == 71);
  BOOST_TEST(system.calls == 5);
  Eigen::VectorXd expected = vector(load);
  for (int key = 0; key < 70; ++key) expected[key % size] -= 0.1 * key;
  BOOST_TEST((system.matrix * vector(answer->x) - expected).norm() < test::rounding * 70 * expected.norm());
}

BOOST_AUTO_TEST_CASE(an_unknown_that_is_given_leaves_to_its_border_what_its_own_equation_lacks) {
  System system(11);
  constexpr double given = -0.3;
  const std::vector<Condition> conditions{newton::given_unknown(2, given)};
  Border border(all_equations);
  const auto answer = border.answer(system.solver(), conditions, system.solve(load));
  BOOST_REQUIRE(answer.has_value());
  BOOST_TEST(!border.has_held());
  const Eigen::VectorXd x = vector(answer->x);
  BOOST_TEST(std::abs(x[2] - given) < test::rounding * x.norm());
  Eigen::VectorXd left = vector(load) - system.matrix * x;
  BOOST_TEST(std::abs(left[2] - answer->z.at(2)) < test::rounding * vector(load).norm());
  left[2] = 0;
  BOOST_TEST(left.norm() < test::rounding * vector(load).norm());
}

BOOST_AUTO_TEST_CASE(an_unknown_of_a_border_can_be_given_without_a_row) {
  System system(12);
  constexpr double given = 0.7;
  const Condition condition{size, {{1, -2.0}, {4, 1.0}}, {}, 1, given};
  const auto answer = Border(all_equations).answer(system.solver(), {condition}, system.solve(load));
  BOOST_REQUIRE(answer.has_value());
  BOOST_TEST(answer->z.at(size) == given);
  Eigen::VectorXd expected = vector(load);
  expected[1] += 2 * given;
  expected[4] -= given;
  BOOST_TEST((system.matrix * vector(answer->x) - expected).norm() < test::rounding * expected.norm());
}

BOOST_AUTO_TEST_CASE(an_answer_is_the_solution_of_the_right_hand_side_that_holds_the_conditions_in_the_kept_equations) {
  System system(8);
  Border border([] { return std::vector<int>{3, 1, 5}; });
  const std::vector<Condition> conditions = zeros({1, 3});
  std::vector<double> right = load;
  const std::vector<double> free = system.solve(right);
  const auto answer = border.answer(system.solver(), conditions, free);
  BOOST_TEST_REQUIRE(answer.has_value());
  border.hold(system.solver(), conditions, free, right);
  BOOST_TEST(system.solutions == 3);  // the first, and one for each condition
  const std::vector<double> expected = system.solve(right);
  for (int i = 0; i < size; ++i) {
    const double found = indexing::at(answer->x, i);
    if (i == 1 || i == 3 || i == 5) {
      BOOST_TEST(std::abs(found - indexing::at(expected, i)) < test::rounding * vector(expected).norm());
    } else {
      BOOST_TEST(std::isnan(found));
    }
  }
}

BOOST_AUTO_TEST_CASE(conditions_on_equations_that_are_not_kept_are_not_held) {
  System system(8);
  Border border([] { return std::vector<int>{1}; });
  std::vector<double> right = load;
  BOOST_TEST(!border.hold(system.solver(), zeros({1, 3}), system.solve(right), right));
  BOOST_TEST((right == load));
  BOOST_TEST(border.hold(system.solver(), zeros({1}), system.solve(right), right));
}

BOOST_AUTO_TEST_CASE(nothing_that_is_held_costs_nothing) {
  System system(7);
  std::vector<double> right = load;
  BOOST_TEST(Border(all_equations).hold(system.solver(), {}, {}, right));
  BOOST_TEST((right == load));
  BOOST_TEST(system.solutions == 0);
}

BOOST_AUTO_TEST_CASE(a_matrix_that_is_singular_with_them_holds_none) {
  System system(9);
  system.matrix = Eigen::MatrixXd::Identity(size, size);
  system.matrix.topLeftCorner(2, 2) << 0, 1, 1, 0;  // the first unknown is in the second equation only
  std::vector<double> right = load;
  BOOST_TEST(!Border(all_equations).hold(system.solver(), zeros({0}), system.solve(right), right));
  BOOST_TEST(!Border(all_equations).answer(system.solver(), zeros({0}), system.solve(right)).has_value());
  BOOST_TEST((right == load));
}
