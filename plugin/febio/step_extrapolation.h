/// The state at which the first matrix of a time step is formed.
///
/// Newton's method starts a step at the end of the last one. Where a solution evolves smoothly, the polynomial through
/// the last states foretells the next one to a few parts in a hundred, and an iteration that starts there leaves an
/// error smaller by as much again. Only the way to the solution changes: FEBio's increments count from the start of the
/// step, and its convergence test, line search and tolerances act as ever. With p the expected change and K the matrix
/// at x + p, the first increment is
///
///   u = p + K^-1 R(x + p),   that is   K u = R(x + p) + K p .
#pragma once

#include <Eigen/Core>

#include <functional>
#include <vector>

class FEModel;
class FENewtonSolver;

class StepExtrapolation {
 public:
  explicit StepExtrapolation(FEModel& fem) : fem_(fem) {}

  /// Keeps the change of the step that has been solved, and judges by it what would have foretold it best.
  void step_solved();

  /// The next attempt starts at the end of the last step: after a failed one, and in a continued run.
  void skip();

  /// Before the first matrix of a step: moves the model to the expected state, and returns whether there is one. There
  /// `decide` is called, with the solver's increments being the expected ones; what it holds stays where it is put. The
  /// solver's solution vectors remain those of the start of the step.
  bool move_to_expected_state(FENewtonSolver& solver, const std::function<void()>& decide);

  /// With the first matrix formed there: the right-hand side R(x + p) + K p. Nothing happens otherwise.
  void complete_residual(FENewtonSolver& solver);

 private:
  /// Changes of all nodal values (degrees of freedom, nodes) in a step of length dt [s].
  struct Change {
    Eigen::MatrixXd values;
    double dt = 0;
  };
  Eigen::MatrixXd expected(int order, double dt) const;
  double worst_error(const Change& actual, int order) const;
  void choose_order(const Change& actual);

  FEModel& fem_;
  std::vector<Change> last_;         ///< the latest first, two at the most
  int order_ = 0;                    ///< of the polynomial for the next step; 0: none
  std::vector<double> first_guess_;  ///< p, per equation; empty but for the first iteration of a step
};
