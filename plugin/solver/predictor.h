/// Prediction of the state at which the first matrix of a time step is assembled.
///
/// Newton's method starts a step at the end of the last one. If a solution evolves smoothly, polynomials through the
/// last states (past_steps.h) predict the next state to about a thousandth, and the first iteration from there reduces
/// this error by a similar factor. The prediction fails where a load curve has a kink; the step then starts without it.
///
/// Let P be the predicted change, K the matrix at x + P, and theta = 1e-4. The solver counts (1 - theta) P as done, and
/// its first increment is
///
///     u = theta P + K^-1 R(x + P),   that is   K u = R(x + P) + theta K P .
///
/// Its convergence tests therefore compare the correction of the prediction with the change of the whole step, and a
/// step may converge in its first iteration. The tests are as strict as in any later iteration.
///
/// A predicted state is rejected if an element is inverted in it, or if its residual is larger than that of a start
/// without prediction (free values unchanged, prescribed values at their new values). The state of the start without
/// prediction is then restored.
#pragma once

#include "helper.h"
#include "past_steps.h"

#include <string>
#include <vector>

namespace newton {

/// Number of steps without prediction after a failed attempt. It is the number of changes that the polynomials use, so
/// that they then contain later states only; a failed attempt shows that steps of its length are not smooth.
inline constexpr int plain_steps_after_failure = 5;

/// The helper that predicts the state.
class Predictor : public Helper {
 public:
  std::string unavailable(const Solver& solver) const override;
  /// True if the new step starts at a predicted state.
  bool will_predict(const Solver& solver) const;
  bool predict(Solver& solver, const std::function<void()>& arrived) override;
  /// Adds theta K P to the residual of the first iteration, which is then R(x + P) + theta K P.
  void complete_residual(Solver& solver) override;
  bool multiplies_by_matrix() const override { return true; }
  /// Keeps the change of the step, and determines the polynomials that predict it best.
  void end_step(Solver& solver) override;
  void rewind(Solver& solver) override;
  void archive(Archive& archive) override;

 private:
  /// True if a prediction may save iterations.
  bool is_worth_trying() const;
  /// True if the displacements and at least one changing variable can be predicted.
  bool predicts_the_change(const Solver& solver) const;
  /// True if the loads deviate from their prediction, as at a kink of a load curve.
  bool loads_turn(const Solver& solver) const;
  /// The predicted change per equation. `prescribed`: prescribed increments.
  std::vector<double> prediction(const Solver& solver, const std::vector<double>& prescribed) const;
  /// Norm of the residual after a change and an increment; infinite if an element is inverted.
  static double residual_norm(Solver& solver, const std::vector<double>& change, std::vector<double> increment);
  /// True if the residual at the predicted state is not larger than without prediction. It leaves the model at the
  /// predicted state.
  static bool is_better_than_plain(Solver& solver, const std::vector<double>& predicted,
                                   const std::vector<double>& prescribed);
  /// Rejects the prediction: restores the state.
  void drop(Solver& solver, const std::vector<double>& prescribed);
  /// Discards past steps of another step of the analysis.
  void forget_other_analysis_step(const Solver& solver);

  std::vector<PastSteps> variables_;  ///< past changes of each variable, shape (dofs of the variable, nodes)
  std::vector<PastSteps> loads_;      ///< past changes of each load, shape (1, 1)
  std::vector<double> load_values_;   ///< load values at the end of the last step; empty before the first
  int analysis_step_ = -1;            ///< step of the analysis to which the past steps belong
  int plain_steps_ = 0;               ///< number of next steps that start without prediction
  bool has_predicted_ = false;        ///< true if the present step started at the predicted state
  bool is_dropping_ = false;          ///< true while a rejected prediction is undone, which is not a failed attempt
  int iterations_plain_ = 1;          ///< number of iterations of the last step without prediction
  double error_ = 1;          ///< relative error of the prediction of the last change, the largest of all variables
  double error_in_vain_ = 0;  ///< value of error_ for which a prediction saved no iteration
  std::vector<double> part_of_prediction_;  ///< theta P per equation; empty except in the first iteration of a step
};

}  // namespace newton
