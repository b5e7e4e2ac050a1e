#include "fake_solver.h"
#include "solver/predictor.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <memory>

using newton::Predictor;

namespace {

/// A node whose values grow by the same amount in each step. It uses the predictor as FEBio does; the residual is the
/// distance to the solution.
class Ramp {
 public:
  Ramp() {
    solver.residual = [this](const std::vector<double>& values) {
      std::vector<double> distance;
      for (const double value : values) distance.push_back(time - value);
      return distance;
    };
  }

  void begin_step() {
    time += solver.dt;
    solver.loads = {time};
    solver.begin_step();
    predictor.begin_step(solver);
  }
  /// Solves the step, from any start, and ends it.
  void end_step() {
    const double missing = time - solver.total[0];
    solver.solve({missing, missing});
    predictor.end_step(solver);
  }
  void steps(int count) {
    for (int n = 0; n < count; ++n) {
      begin_step();
      end_step();
    }
  }
  bool predict() {
    return predictor.predict(solver, [this] { ++arrivals; });
  }

  FakeSolver solver;
  Predictor predictor;
  double time = 0;
  int arrivals = 0;
};

/// A number of steps that is sufficient for a prediction.
constexpr int enough = 3;

class MemoryArchive : public newton::Archive {
 public:
  void part(int& value) override { store(ints_, value); }
  void part(double& value) override { store(doubles_, value); }
  void part(std::vector<double>& values) override { store(vectors_, values); }
  void part(Eigen::MatrixXd& values) override { store(matrices_, values); }
  bool is_reading = false;

 private:
  template <class T>
  void store(std::vector<T>& kept, T& value) {
    if (!is_reading) {
      kept.push_back(value);
    } else {
      value = kept.front();
      kept.erase(kept.begin());
    }
  }
  std::vector<int> ints_;
  std::vector<double> doubles_;
  std::vector<std::vector<double>> vectors_;
  std::vector<Eigen::MatrixXd> matrices_;
};

}  // namespace

BOOST_AUTO_TEST_CASE(nothing_is_predicted_before_two_changes_are_known) {
  Ramp ramp;
  for (int n = 0; n < enough; ++n) {
    ramp.begin_step();
    BOOST_TEST(!ramp.predict());
    ramp.end_step();
  }
  ramp.begin_step();
  BOOST_TEST(ramp.predictor.will_predict(ramp.solver));
}

BOOST_AUTO_TEST_CASE(a_smooth_step_begins_at_the_predicted_state) {
  Ramp ramp;
  ramp.steps(enough);
  ramp.begin_step();
  BOOST_TEST(ramp.predict());
  BOOST_TEST(ramp.arrivals == 1);
  BOOST_TEST(ramp.solver.values()[0] == ramp.time, boost::test_tools::tolerance(1e-14));
  // All but 1e-4 of the change counts as done, and the first increment finds the rest.
  BOOST_TEST(ramp.solver.totals[0] == 1 - 1e-4, boost::test_tools::tolerance(1e-14));
  ramp.solver.load = {0, 0};
  ramp.predictor.complete_residual(ramp.solver);
  BOOST_TEST(ramp.solver.load[0] == 1e-4, boost::test_tools::tolerance(1e-12));
  ramp.predictor.complete_residual(ramp.solver);  // only the first matrix has this part
  BOOST_TEST(ramp.solver.load[0] == 1e-4, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(what_prescribed_increments_add_is_not_counted_twice) {
  Ramp ramp;
  ramp.steps(enough);
  ramp.begin_step();
  ramp.predict();
  ramp.solver.load = {0.5, 0};
  ramp.solver.prescribed_load = {0.5, 0};
  ramp.predictor.complete_residual(ramp.solver);
  BOOST_TEST(ramp.solver.load[0] == 1e-4, boost::test_tools::tolerance(1e-10));
}

BOOST_AUTO_TEST_CASE(without_known_totals_the_whole_prediction_is_left_to_the_first_increment) {
  Ramp ramp;
  ramp.solver.known_totals = false;
  ramp.steps(enough);
  ramp.begin_step();
  BOOST_TEST(ramp.predict());
  BOOST_TEST(ramp.solver.totals[0] == 0);
  ramp.predictor.complete_residual(ramp.solver);
  BOOST_TEST(ramp.solver.load[0] == 1, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_load_that_turns_predicts_nothing) {
  Ramp ramp;
  ramp.steps(enough);
  ramp.begin_step();
  ramp.solver.loads = {ramp.time - 1};
  BOOST_TEST(!ramp.predict());
  BOOST_TEST(ramp.solver.evaluations == 0);
}

BOOST_AUTO_TEST_CASE(a_model_whose_motion_is_not_known_beforehand_is_not_predicted) {
  Ramp ramp;
  ramp.steps(enough);
  ramp.begin_step();
  ramp.solver.predictable = false;
  BOOST_TEST(!ramp.predict());
}

BOOST_AUTO_TEST_CASE(another_step_of_the_analysis_starts_from_nothing) {
  Ramp ramp;
  ramp.steps(enough);
  ramp.solver.step_of_analysis = 1;
  ramp.begin_step();
  BOOST_TEST(!ramp.predict());
}

BOOST_AUTO_TEST_CASE(steps_of_one_iteration_need_no_prediction) {
  Ramp ramp;
  ramp.solver.taken_iterations = 1;
  ramp.steps(enough);
  ramp.begin_step();
  BOOST_TEST(!ramp.predict());
}

BOOST_AUTO_TEST_CASE(a_prediction_that_inverts_an_element_is_dropped_and_the_state_restored) {
  Ramp ramp;
  ramp.steps(enough);
  ramp.begin_step();
  ramp.solver.increment = {0.25, 0};
  const std::vector<double> values = ramp.solver.values();
  const std::vector<double> change = ramp.solver.change;
  ramp.solver.is_inverted = [&](const std::vector<double>& at) { return at[0] > ramp.time - 0.1; };
  int restored = 0;
  ramp.solver.on_restore = [&] {
    ++restored;
    ramp.predictor.rewind(ramp.solver);  // FEBio reports every restored state in this way
  };
  BOOST_TEST(!ramp.predict());
  BOOST_TEST(restored == 1);
  BOOST_TEST(ramp.arrivals == 0);
  BOOST_TEST(ramp.solver.values() == values);
  BOOST_TEST(ramp.solver.change == change);
  BOOST_TEST(ramp.solver.increment[0] == 0.25);
  BOOST_TEST(
      ramp.solver.lines.back().find("predictor: the predicted state is rejected, because it inverts an element") == 0);
  const std::vector<double> load = ramp.solver.load;
  ramp.predictor.complete_residual(ramp.solver);
  BOOST_TEST(ramp.solver.load == load);
  // The rejected prediction is not a failed attempt: the next step may begin with a prediction.
  ramp.solver.is_inverted = [](const std::vector<double>&) { return false; };
  ramp.end_step();
  ramp.begin_step();
  BOOST_TEST(ramp.predict());
}

BOOST_AUTO_TEST_CASE(a_prediction_with_a_larger_residual_than_the_plain_start_is_dropped) {
  Ramp ramp;
  ramp.steps(enough);
  ramp.begin_step();
  const std::vector<double> values = ramp.solver.values();
  const double start = ramp.time - 1;
  ramp.solver.residual = [start](const std::vector<double>& at) {
    return std::vector<double>{1 + std::abs(at[0] - start), 0.0};
  };
  BOOST_TEST(!ramp.predict());
  BOOST_TEST(ramp.solver.values() == values);
  BOOST_TEST(ramp.solver.lines.back().find("predictor: the predicted state is rejected, because its residual") == 0);
}

BOOST_AUTO_TEST_CASE(a_residual_that_is_no_number_is_larger) {
  Ramp ramp;
  ramp.steps(enough);
  ramp.begin_step();
  const double start = ramp.time - 1;
  ramp.solver.residual = [start](const std::vector<double>& at) {
    return std::vector<double>{at[0] > start ? std::numeric_limits<double>::quiet_NaN() : 1.0, 0.0};
  };
  BOOST_TEST(!ramp.predict());
}

BOOST_AUTO_TEST_CASE(the_plain_start_has_prescribed_values_where_they_will_be) {
  // Node 1 is prescribed from 0 to 1 in each step and moves node 0: without motion of node 0, the residual is the
  // prescribed increment.
  FakeSolver solver(2);
  solver.set_equation({1, 0}, newton::prescribed(2));
  solver.residual = [](const std::vector<double>& at) { return std::vector<double>{at[2] - at[0], 0.0, 0.0, 0.0}; };
  Predictor predictor;
  for (int n = 1; n <= enough; ++n) {
    solver.begin_step();
    solver.loads = {double(n)};
    solver.set_value({1, 0}, n);
    solver.solve({1, 0, 0, 0});
    predictor.end_step(solver);
  }
  solver.begin_step();
  solver.loads = {enough + 1.0};
  solver.increment = {0, 0, 1, 0};
  BOOST_TEST(predictor.predict(solver, [] {}));
}

BOOST_AUTO_TEST_CASE(after_a_failed_attempt_steps_start_plainly_for_a_while) {
  Ramp ramp;
  ramp.steps(enough);
  ramp.begin_step();
  BOOST_TEST(ramp.predict());
  ramp.predictor.rewind(ramp.solver);
  for (int n = 0; n < newton::plain_steps_after_failure; ++n) {
    BOOST_TEST(!ramp.predict());
    ramp.end_step();
    ramp.begin_step();
  }
  BOOST_TEST(ramp.predict());
}

BOOST_AUTO_TEST_CASE(a_continued_run_predicts_as_one_that_was_not_interrupted) {
  for (const bool failed : {false, true}) {
    Ramp ramp;
    ramp.steps(enough);
    if (failed) ramp.predictor.rewind(ramp.solver);
    MemoryArchive archive;
    ramp.predictor.archive(archive);
    archive.is_reading = true;
    Predictor continued;
    continued.archive(archive);
    ramp.begin_step();
    BOOST_TEST(continued.will_predict(ramp.solver) == !failed);
    BOOST_TEST(continued.will_predict(ramp.solver) == ramp.predictor.will_predict(ramp.solver));
  }
}

BOOST_AUTO_TEST_CASE(it_says_where_it_cannot_help) {
  Ramp ramp;
  BOOST_TEST(ramp.predictor.unavailable(ramp.solver).empty());
  ramp.solver.predictable = false;
  BOOST_TEST(ramp.predictor.unavailable(ramp.solver) == "is not available in models with rigid bodies; set it to 0.");
}
