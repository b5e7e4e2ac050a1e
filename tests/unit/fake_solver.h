/// A solver for tests of the helpers: a model of free and prescribed nodal values with any residual.
#pragma once

#include "solver/solver.h"

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <string>
#include <vector>

/// A model with one displacement (dof 0) and one concentration (dof 1) at each node. The equations are ordered by
/// nodes. Tests set the residual and the matrix.
class FakeSolver : public newton::Solver {
 public:
  using Place = newton::Place;

  explicit FakeSolver(int nodes = 1) : nodes_(nodes), state_(nodes) {
    for (int n = 0; n < 2 * nodes; ++n) codes_.push_back(n);
    matrix = Eigen::MatrixXd::Identity(2 * nodes, 2 * nodes);
    reset_vectors();
    residual = [](const std::vector<double>& values) { return std::vector<double>(values.size(), 0.0); };
    is_inverted = [](const std::vector<double>& /*values*/) { return false; };
  }

  // ------------------------------------------------------------ data of the tests

  bool newton = true;
  bool clamps = false;
  bool predictable = true;
  bool known_totals = true;
  double tolerance = 0.9;
  bool halves_inversions = false;
  double least_residual = 1e-20;
  bool has_forces_alone = true;
  bool searches = true;
  ResidualSquares squares{1, 1};
  int taken_iterations = 3;
  double dt = 1;
  int step_of_analysis = 0;
  std::vector<double> loads{0};
  std::vector<double> reactions;
  Eigen::MatrixXd matrix;
  std::function<std::vector<double>(const std::vector<double>& values)> residual;
  std::function<bool(const std::vector<double>& values)> is_inverted;
  mutable std::vector<std::string> lines;
  std::vector<double> total, change, increment, load, prescribed_load;
  std::vector<double> totals;  ///< totals of the convergence tests
  std::function<void()> on_restore;

  const std::vector<double>& values() const { return state_.values; }

  /// The three functions make a step as a solver does: start, solution with a change, end.
  void begin_step() {
    state_.previous = state_.values;
    std::fill(change.begin(), change.end(), 0.0);
    std::fill(increment.begin(), increment.end(), 0.0);
  }
  void solve(const std::vector<double>& by) {
    change = by;
    std::vector<double> none(by.size(), 0.0);
    update(none);
    for (std::size_t n = 0; n < by.size(); ++n) total[n] += by[n];
  }

  // ------------------------------------------------------------ newton::Solver

  bool is_newton() const override { return newton; }
  int nodes() const override { return nodes_; }
  std::vector<std::vector<int>> variables() const override { return {{0}, {1}}; }
  std::size_t displacements() const override { return 0; }
  std::vector<int> concentrations() const override { return {1}; }
  int equation(Place place) const override { return indexing::at(codes_, index(place)); }
  void set_equation(Place place, int code) override { indexing::at(codes_, index(place)) = code; }
  double value(Place place) const override { return indexing::at(state_.values, index(place)); }
  void set_value(Place place, double value) override { indexing::at(state_.values, index(place)) = value; }
  double previous_value(Place place) const override { return indexing::at(state_.previous, index(place)); }
  newton::Vectors vectors() override { return {total, change, increment, load, prescribed_load}; }

  /// Sets free values to total + change + increment; with the clamp, negative concentrations become 0.
  void update(std::vector<double>& by) override {
    for (int n = 0; n < 2 * nodes_; ++n) {
      double& value = indexing::at(state_.values, n);
      if (indexing::at(codes_, n) >= 0)
        value = indexing::at(total, n) + indexing::at(change, n) + indexing::at(by, n);
      else if (n % 2 == 0)
        value += indexing::at(by, n);
      if (clamps && n % 2 == 1 && value < 0) value = 0;
    }
    if (is_inverted(state_.values)) throw newton::InvertedElement();
  }
  std::vector<double> evaluate_residual() override {
    ++evaluations;
    return residual(state_.values);
  }
  int evaluations = 0;

  std::vector<double> times_matrix(const std::vector<double>& vector) const override {
    const Eigen::VectorXd product = matrix * Eigen::Map<const Eigen::VectorXd>(vector.data(), matrix.cols());
    return {product.begin(), product.end()};
  }
  bool has_known_totals() const override { return known_totals; }
  void set_totals(const std::vector<double>& by) override { change = totals = by; }
  const std::vector<double>* reactions_of_clamp() const override { return clamps ? &reactions : nullptr; }
  LineSearch line_search() override { return searches ? LineSearch{&tolerance, &halves_inversions} : LineSearch(); }
  ResidualSquares residual_squares() override {
    return {squares.now, squares.first, has_forces_alone ? &least_residual : nullptr};
  }
  int iterations() const override { return taken_iterations; }
  bool is_predictable() const override { return predictable; }
  double time_increment() const override { return dt; }
  int analysis_step() const override { return step_of_analysis; }
  std::vector<double> load_values() const override { return loads; }
  void save_state() override {
    saved_ = std::make_unique<State>(state_);
    saved_change_ = change;
  }
  void restore_state() override {
    state_ = *saved_;
    change = saved_change_;
    if (on_restore) on_restore();
  }
  void log(const std::string& line) const override { lines.push_back(line); }

 private:
  struct State {
    explicit State(int nodes) : values(std::size_t(2 * nodes), 0.0) { previous = values; }
    std::vector<double> values, previous;
  };
  static int index(Place place) { return 2 * place.node + place.dof; }
  void reset_vectors() {
    for (auto* vector : {&total, &change, &increment, &load, &prescribed_load, &reactions, &totals})
      vector->assign(state_.values.size(), 0.0);
  }

  int nodes_;
  State state_;
  std::vector<int> codes_;
  std::unique_ptr<State> saved_;
  std::vector<double> saved_change_;
};
