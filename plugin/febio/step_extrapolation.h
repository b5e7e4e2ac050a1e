/// The state at which the first matrix of a time step is formed.
///
/// Newton's method starts a step at the end of the last one. Where a solution evolves smoothly, a curve between the
/// line and the parabola through the last states foretells the next one to a part in a hundred, and an iteration that
/// starts there leaves an error smaller by as much again. Where a load curve turns it does not, and the step starts as
/// FEBio would. Only the way to the solution changes: FEBio's increments count from the start of the step, and its
/// convergence test, line search and tolerances act as ever. With p the expected change and K the matrix at x + p, the
/// first increment is
///
///   u = p + K^-1 R(x + p),   that is   K u = R(x + p) + K p .
#pragma once

#include <Eigen/Core>

#include <functional>
#include <vector>

class DumpStream;
class FEModel;
class FENewtonSolver;

class StepExtrapolation {
 public:
  explicit StepExtrapolation(FEModel& fem) : fem_(fem) {}

  /// Rigid bodies move with unknowns of their own, which are not extrapolated.
  static bool is_available(FEModel& fem);

  /// Keeps the change of the step that has been solved, and judges by it what would have foretold it best. Where steps
  /// take one iteration, or FEBio's usual least number and no fewer from the expected state, it is left out.
  void step_solved(int iterations);

  /// A continued run goes on as if it had not been interrupted. After a failed attempt, when FEBio restores the state
  /// in memory, the next one starts at the end of the last step.
  void serialize(DumpStream& ar);

  /// At the start of a step, whether it is to begin at the expected state.
  bool begins_ahead() const;

  /// Before the first matrix of a step: moves the model to the expected state, and returns whether there is one. There
  /// `decide` is called, with the solver's increments being the expected ones; what it holds stays where it is put. The
  /// solver's solution vectors remain those of the start of the step.
  bool move_to_expected_state(FENewtonSolver& solver, const std::function<void()>& decide);

  /// With the first matrix formed there: the right-hand side R(x + p) + K p. Nothing happens otherwise.
  void complete_residual(FENewtonSolver& solver);

 private:
  /// What a step of length dt [s] changed.
  struct Change {
    Eigen::MatrixXd values;  ///< nodal ones (degrees of freedom, nodes)
    Eigen::MatrixXd loads;   ///< of load controllers (controllers, 1)
    double dt = 0;
  };
  /// Changes that the last states foretell: by the line through two of them, and what the parabola through three adds.
  struct Foretold {
    Eigen::MatrixXd line;
    Eigen::MatrixXd bend;
  };
  Foretold foretold(Eigen::MatrixXd Change::* of, double dt) const;
  static Eigen::MatrixXd best_weights(const Foretold& told, const Eigen::MatrixXd& change,
                                      const std::vector<std::vector<int>>& groups);
  static Eigen::MatrixXd expected(const Foretold& told, const Eigen::MatrixXd& weights);
  void choose_weights(const Change& actual);
  bool loads_turn() const;

  FEModel& fem_;
  std::vector<Change> last_;         ///< within an analysis step; the latest first, two at the most
  int analysis_step_ = -1;           ///< whose changes those are
  Eigen::MatrixXd loads_;            ///< at the end of the last step, (controllers, 1); empty before the first
  Eigen::MatrixXd value_weights_;    ///< of what is foretold in the expected change (degrees of freedom, 2)
  Eigen::MatrixXd load_weights_;     ///< likewise (controllers, 2)
  bool ahead_ = false;               ///< whether the present step began at the expected state
  int iterations_ahead_ = 0;         ///< of the last step that did; none yet: to be tried
  int iterations_plain_ = 1;         ///< of the last step that did not
  std::vector<double> first_guess_;  ///< p, per equation; empty but for the first iteration of a step
};
