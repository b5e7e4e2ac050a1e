/// The state at which the first matrix of a time step is formed.
///
/// Newton's method starts a step at the end of the last one. If a solution evolves smoothly, curves through the last
/// states predict the next one to a part in a thousand (past_steps.h), and an iteration that starts there leaves an
/// error smaller by as much again. The curves fail where a load curve turns, and the step starts plainly.
///
/// With P the predicted change, the solver counts (1 - theta) P as done, theta being 1e-4, and with K the matrix at
/// x + P its first increment is
///
///   u = theta P + K^-1 R(x + P),   that is   K u = R(x + P) + theta K P .
///
/// Its tests therefore see by how much the increment corrects the prediction, next to the change of the whole step, and
/// a step may end with its first iteration. They are as strict as in any later iteration.
///
/// A predicted state is dropped, and the state of the plain start restored, where an element is inverted there, or
/// where the residual is larger than that of the plain start: free values unchanged, prescribed ones at their new
/// values.
#pragma once

#include "helper.h"
#include "past_steps.h"

#include <string>
#include <vector>

namespace newton {

/// A failed attempt shows that steps as long as it are not smooth. After it as many steps start plainly as the curves
/// take changes from, so that the curves contain later states alone.
inline constexpr int plain_steps_after_failure = 5;

class Predictor : public Helper {
 public:
  explicit Predictor(Solver& solver) : solver_(solver) {}

  std::string unavailable() const override;
  /// Whether the new step starts at a predicted state.
  bool will_predict() const;
  bool predict(const std::function<void()>& arrived) override;
  /// The right-hand side R(x + P) + theta K P.
  void complete_residual() override;
  bool multiplies_by_matrix() const override { return true; }
  /// Keeps the change of the step, and judges by it which curves predict best.
  void end_step() override;
  void rewind() override;
  void archive(Archive& archive) override;

 private:
  bool is_worth_trying() const;
  bool predicts_the_change() const;
  bool loads_turn() const;
  std::vector<double> prediction(const std::vector<double>& prescribed) const;
  double residual_norm(const std::vector<double>& change, std::vector<double> increment);
  bool is_better_than_plain(const std::vector<double>& predicted, const std::vector<double>& prescribed);
  void drop(const std::vector<double>& prescribed);
  void forget_other_analysis_step();

  Solver& solver_;
  std::vector<PastSteps> variables_;  ///< (dofs of the variable, nodes) each
  std::vector<PastSteps> loads_;      ///< of each load, (1, 1)
  std::vector<double> load_values_;   ///< at the end of the last step; empty before the first
  int analysis_step_ = -1;            ///< whose steps those are
  int plain_steps_ = 0;               ///< how many steps from now on start plainly
  bool has_predicted_ = false;        ///< whether the present step began at the predicted state
  bool is_dropping_ = false;          ///< whether the restored state is a dropped prediction and no failed attempt
  int iterations_plain_ = 1;          ///< of the last step that began plainly
  double error_ = 1;                  ///< of the prediction of the last change, the largest of a variable
  double error_in_vain_ = 0;          ///< the same where a prediction saved no iteration
  std::vector<double> part_of_prediction_;  ///< theta P, per equation; empty except in the first iteration of a step
};

}  // namespace newton
