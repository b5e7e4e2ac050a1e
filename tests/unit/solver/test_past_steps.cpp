#include "solver/past_steps.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <type_traits>
#include <vector>

using Eigen::MatrixXd;
using Eigen::RowVector2d;
using newton::PastSteps;

namespace {

/// States of two nodes as a function of time.
using State = std::function<RowVector2d(double)>;

MatrixXd change(const State& state, double from, double to) { return state(to) - state(from); }

/// Past steps of a quantity, and the time at their end.
struct Path {
  PastSteps steps;
  double time = 0;
};

Path path(const State& state, double start, const std::vector<double>& lengths) {
  Path path{{}, start};
  for (const double dt : lengths) {
    path.steps.add({change(state, path.time, path.time + dt), dt});
    path.time += dt;
  }
  return path;
}

/// Step lengths that grow by a constant factor.
std::vector<double> growing(double first, double factor, int count) {
  std::vector<double> lengths;
  for (int n = 0; n < count; ++n) lengths.push_back(first * std::pow(factor, n));
  return lengths;
}

/// Rounding error of a prediction. A divided difference of degree m over equal steps is a sum of 2^m states with
/// rounding errors; degrees 1 to 5 are summed, and the factor on the last one is a quotient of two sums.
double rounding_of(const RowVector2d& state) {
  return 128 * std::numeric_limits<double>::epsilon() * state.cwiseAbs().maxCoeff();
}

double error(const Path& path, const State& state, double dt) {
  const MatrixXd predicted = path.steps.predicted(dt);
  BOOST_REQUIRE(predicted.size() == 2);
  return (predicted - change(state, path.time, path.time + dt)).cwiseAbs().maxCoeff();
}

}  // namespace

BOOST_AUTO_TEST_CASE(nothing_is_predicted_before_the_second_step) {
  const State line = [](double t) { return RowVector2d(t, 2 * t); };
  BOOST_TEST(PastSteps().predicted(1).size() == 0);
  BOOST_TEST(path(line, 0, {1}).steps.predicted(1).size() == 0);
  BOOST_TEST(path(line, 0, {1, 1}).steps.predicted(1).size() == 2);
}

BOOST_AUTO_TEST_CASE(a_motion_at_constant_speed_goes_on_whatever_the_steps) {
  const State line = [](double t) { return RowVector2d(3 * t, 1 - t); };
  const Path past = path(line, 0, {1, 0.3, 2, 0.1, 5, 5, 5});
  for (const double dt : {1e-3, 1.0, 100.0}) BOOST_TEST(error(past, line, dt) <= rounding_of(line(past.time + dt)));
  BOOST_TEST(past.steps.prediction_error() <= rounding_of(RowVector2d(2, 2)));
}

BOOST_AUTO_TEST_CASE(a_parabola_in_time_is_predicted_over_uneven_steps) {
  const State parabola = [](double t) { return RowVector2d(1 + t + t * t, t - 3 * t * t); };
  const Path past = path(parabola, 0, {1, 2.5, 0.7, 3});
  BOOST_TEST(error(past, parabola, 6) <= rounding_of(parabola(past.time + 6)));
}

BOOST_AUTO_TEST_CASE(a_decay_over_equal_steps_is_predicted_exactly) {
  const State decay = [](double t) { return RowVector2d(std::exp(-0.3 * t), -2 * std::exp(-0.3 * t)); };
  for (const int count : {4, 5, 9}) {
    const Path past = path(decay, 0, growing(1, 1, count));
    BOOST_TEST(error(past, decay, 1) <= rounding_of(RowVector2d(2, 2)));
  }
}

BOOST_AUTO_TEST_CASE(what_is_a_polynomial_of_the_number_of_steps_is_predicted_over_growing_ones) {
  // If step lengths grow by the factor r, t = (r^s - 1)/(r - 1) after s steps.
  const double r = 1.2;
  const State quintic = [r](double t) {
    const double steps = std::log1p((r - 1) * t) / std::log(r);
    return RowVector2d(std::pow(steps, 5), std::pow(steps, 3));
  };
  const Path past = path(quintic, 0, growing(1, r, 12));
  BOOST_TEST(error(past, quintic, std::pow(r, 12)) <= rounding_of(quintic(past.time + std::pow(r, 12))));
}

BOOST_AUTO_TEST_CASE(growth_is_predicted_to_the_sixth_difference) {
  // With sqrt t = r^(s/2) and t = r^s, a polynomial of degree m has the error of differences of order m + 1: (1 -
  // 1/sqrt r)^(m+1) and (1 - 1/r)^(m+1) times the states.
  const double r = 1.15;
  const State root = [](double t) { return RowVector2d(std::sqrt(t), t); };
  const Path past = path(root, 1 / (r - 1), growing(1, r, 10));
  const double next = std::pow(r, 10);
  BOOST_TEST(error(past, root, next) <= std::pow(1 - 1 / r, 6) * root(past.time + next).maxCoeff());
}

BOOST_AUTO_TEST_CASE(a_step_far_longer_than_the_last_is_predicted_by_a_parabola_at_the_most) {
  const State cubic = [](double t) { return RowVector2d(t * t * t, t); };
  const Path past = path(cubic, 10, growing(1, 1, 8));
  const double dt = 10;
  const double error_of_parabola = dt * (dt + 1) * (dt + 2);  // the third divided difference is 1
  BOOST_TEST(error(past, cubic, 1) <= rounding_of(cubic(past.time + 1)));
  BOOST_TEST(std::abs(error(past, cubic, dt) - error_of_parabola) <= rounding_of(cubic(past.time + dt)));
}

BOOST_AUTO_TEST_CASE(steps_that_shrink_to_a_point_tell_nothing_beyond_it_by_stretched_time) {
  // If step lengths shrink by the factor r, t = (1 - r^s)/(1 - r) after s steps; they would end at 1/(1 - r).
  const double r = 0.61;
  const State quintic = [r](double t) {
    const double steps = std::log1p(-(1 - r) * t) / std::log(r);
    return RowVector2d(std::pow(steps, 5), std::pow(steps, 3));
  };
  const Path past = path(quintic, 0, growing(1, r, 8));
  const double next = std::pow(r, 8);
  const double left = 1 / (1 - r) - past.time;
  // Time has a rounding error of 1e-16, which changes s by that error divided by the remaining time.
  BOOST_TEST(error(past, quintic, next) <= rounding_of(quintic(past.time + next)) / left);
  for (const double dt : {left, 2 * left, 100 * left}) BOOST_TEST(past.steps.predicted(dt).allFinite());
}

BOOST_AUTO_TEST_CASE(nothing_is_predicted_after_a_turn) {
  const State there_and_back = [](double t) { return RowVector2d(t < 4 ? t : 8 - t, 0); };
  BOOST_TEST(path(there_and_back, 0, growing(1, 1, 4)).steps.prediction_error() <= rounding_of(RowVector2d(4, 4)));
  const Path turned = path(there_and_back, 0, growing(1, 1, 5));
  BOOST_TEST(turned.steps.prediction_error() == 1.0);
  BOOST_TEST(!turned.steps.predicts(1));
  BOOST_TEST(turned.steps.predicted(1).size() == 0);
}

BOOST_AUTO_TEST_CASE(what_rests_is_predicted_to_rest) {
  const State rest = [](double) { return RowVector2d(2, 3); };
  const Path past = path(rest, 0, growing(1, 1.1, 8));
  BOOST_TEST(!past.steps.changed());
  BOOST_TEST(past.steps.prediction_error() == 0.0);
  BOOST_TEST(past.steps.predicted(1).isZero(0));
}

BOOST_AUTO_TEST_CASE(a_copy_by_parts_tells_the_same) {
  const State root = [](double t) { return RowVector2d(std::sqrt(1 + t), t); };
  Path past = path(root, 0, growing(1, 1.1, 8));
  std::vector<double> numbers;
  std::vector<MatrixXd> matrices;
  const auto save = [&](auto& part) {
    if constexpr (std::is_same_v<std::decay_t<decltype(part)>, MatrixXd>)
      matrices.push_back(part);
    else
      numbers.push_back(part);
  };
  past.steps.for_each_part(save);
  auto number = numbers.begin();
  auto matrix = matrices.begin();
  const auto load = [&](auto& part) {
    using Part = std::decay_t<decltype(part)>;
    if constexpr (std::is_same_v<Part, MatrixXd>)
      part = *matrix++;
    else
      part = static_cast<Part>(*number++);
  };
  PastSteps copy;
  copy.for_each_part(load);
  BOOST_TEST((copy.predicted(2) == past.steps.predicted(2)));
  BOOST_TEST(copy.prediction_error() == past.steps.prediction_error());
}
