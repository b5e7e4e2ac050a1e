#include "newton/splitting.h"

#include "random_contact.h"

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>

#include <limits>

using newton::MatrixPart;
using newton::Splitting;

namespace {

constexpr int size = 6;
const std::vector<double> load{1, -2, 3, 0.5, -1, 2};

Eigen::VectorXd vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), indexing::number_of(values));
}

std::vector<int> all_equations() { return {0, 1, 2, 3, 4, 5}; }

/// A part that turns a vector and makes it `factor` times as long: beside the unit matrix each sweep reduces the error
/// by exactly this factor.
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

/// The unit matrix, which counts how often it is solved with.
struct UnitMatrix {
  std::function<std::vector<double>(const std::vector<double>&)> solver() {
    return [this](const std::vector<double>& right) {
      ++solutions;
      return right;
    };
  }
  int solutions = 0;
};

/// All sweeps for one right-hand side with the unit matrix, the last of which is the caller's.
Eigen::VectorXd solved(Splitting& splitting, UnitMatrix& unit, const MatrixPart& part,
                       const std::vector<double>& right) {
  const Eigen::VectorXd x = vector(right) - vector(splitting.product(unit.solver(), {&part}, right));
  splitting.swept({x.begin(), x.end()});
  return x;
}

Eigen::VectorXd exact(const Eigen::MatrixXd& values) {
  return (Eigen::MatrixXd::Identity(size, size) + values).partialPivLu().solve(vector(load));
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_sweep_that_is_left_to_the_caller_meets_the_tolerance) {
  for (const double factor : {0.01, 0.1, 0.3, 0.45}) {
    for (const double tolerance : {1e-1, 1e-3, 1e-6}) {
      const Eigen::MatrixXd values = turn(factor);
      const MatrixPart part = part_of(values);
      UnitMatrix unit;
      Splitting splitting(tolerance);
      // After k sweeps the change is factor^k |b|, and the last sweep leaves factor^(k+2) |x|, the limit's factor^2 of
      // the change over |b|/|x| >= 1: within the tolerance of |x_k|, which is off from |x| by factor^(k+1) at most.
      const double bound = (1 + factor) * tolerance + test::rounding;
      for (int n = 0; n < 2; ++n) {  // the second time it knows the factor
        const Eigen::VectorXd x = solved(splitting, unit, part, load);
        BOOST_TEST(splitting.converges());
        BOOST_TEST((x - exact(values)).norm() <= bound * exact(values).norm());
        BOOST_TEST(std::abs(splitting.reduction() - factor) <= 1e3 * test::rounding);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(what_is_known_of_a_part_saves_solutions) {
  const MatrixPart part = part_of(turn(0.09));
  UnitMatrix unit;
  Splitting splitting(1e-2);
  solved(splitting, unit, part, load);
  BOOST_TEST(unit.solutions == 2);
  solved(splitting, unit, part, load);
  BOOST_TEST(unit.solutions == 3);
  // Of a part that is larger than the last one the caller's sweep tells.
  const MatrixPart larger = part_of(turn(0.3));
  solved(splitting, unit, larger, load);
  BOOST_TEST(unit.solutions == 4);
  BOOST_TEST(splitting.converges());
  BOOST_TEST(std::abs(splitting.reduction() - 0.3) < test::rounding);
  solved(splitting, unit, larger, load);
  BOOST_TEST(unit.solutions == 7);  // 0.3^4 is the first even power within a hundredth: two sweeps and the last one
}

BOOST_AUTO_TEST_CASE(what_is_known_can_be_handed_on) {
  const MatrixPart part = part_of(turn(0.09));
  UnitMatrix unit;
  Splitting splitting(1e-2);
  splitting.set_reduction(0.09);
  solved(splitting, unit, part, load);
  BOOST_TEST(unit.solutions == 1);
}

BOOST_AUTO_TEST_CASE(a_part_that_sweeps_do_not_converge_for_is_told) {
  const Eigen::MatrixXd values = turn(0.7);
  const MatrixPart part = part_of(values);
  UnitMatrix unit;
  Splitting slow(1e-2);
  const std::vector<double> product = slow.product(unit.solver(), {&part}, load);
  BOOST_TEST(!slow.converges());
  BOOST_TEST((vector(product) - values * vector(load)).norm() < test::rounding * vector(load).norm());
  const MatrixPart larger = part_of(turn(3));
  Splitting none(1e-2);
  BOOST_TEST(none.product(unit.solver(), {&larger}, load).empty());
  BOOST_TEST(!none.converges());
}

BOOST_AUTO_TEST_CASE(a_part_that_has_become_too_large_is_told_by_the_last_sweep) {
  UnitMatrix unit;
  Splitting splitting(1e-2);
  splitting.set_reduction(0.05);
  const MatrixPart part = part_of(turn(0.7));
  solved(splitting, unit, part, load);
  BOOST_TEST(unit.solutions == 1);
  BOOST_TEST(!splitting.converges());
}

BOOST_AUTO_TEST_CASE(a_later_sweep_that_makes_the_change_larger_counts_for_nothing) {
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(size, size);
  values(1, 0) = 0.4;
  values(0, 1) = 2;
  const MatrixPart part = part_of(values);
  UnitMatrix unit;
  Splitting splitting(1e-2);
  const std::vector<double> product = splitting.product(unit.solver(), {&part}, {1, 0, 0, 0, 0, 0});
  BOOST_TEST(!splitting.converges());
  BOOST_TEST((product == std::vector<double>{0, 0.4, 0, 0, 0, 0}));  // of the first sweep
}

BOOST_AUTO_TEST_CASE(what_is_no_number_says_nothing_of_a_part) {
  const MatrixPart part = part_of(turn(0.1));
  UnitMatrix unit;
  Splitting splitting(1e-2);
  const std::vector<double> broken(size, std::numeric_limits<double>::quiet_NaN());
  BOOST_TEST(splitting.product(unit.solver(), {&part}, broken).empty());
  splitting.swept(broken);
  BOOST_TEST(splitting.converges());
  BOOST_TEST(splitting.reduction() == 1);
}

BOOST_AUTO_TEST_CASE(no_part_costs_nothing) {
  const MatrixPart none;
  UnitMatrix unit;
  Splitting splitting(1e-2);
  BOOST_TEST(splitting.product(unit.solver(), {&none}, load).empty());
  BOOST_TEST(splitting.converges());
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
