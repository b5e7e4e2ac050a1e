/// The state at which the first matrix of a time step is formed.
///
/// Newton's method starts a step at the end of the last one. Where a solution evolves smoothly, curves through the last
/// states foretell the next one to a part in a thousand (host/past_steps.h), and an iteration that starts there leaves
/// an error smaller by as much again. Where a load curve turns they do not, and the step starts as FEBio would.
///
/// With P the expected change, FEBio counts (1 - theta) P as done, theta being 1e-4, and with K the matrix at x + P its
/// first increment is
///
///   u = theta P + K^-1 R(x + P),   that is   K u = R(x + P) + theta K P .
///
/// So its tests see by how much the increment corrects what was expected, next to the change of the whole step, and a
/// step may end with its first iteration. What they ask for is what they ask of any later iteration.
#pragma once

#include "host/past_steps.h"

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

  /// The arc-length method finds its loads itself: where a step leads is not known before.
  static bool suits(const FENewtonSolver* solver);

  /// Keeps the change of the step that has been solved, and judges by it what would have foretold it best.
  void step_solved(int iterations);

  /// A continued run goes on as if it had not been interrupted. After a failed attempt, when FEBio restores the state
  /// in memory, the next one starts at the end of the last step.
  void serialize(DumpStream& ar);

  /// At the start of a step, whether it is to begin at the expected state.
  bool begins_ahead() const;

  /// Before the first matrix of a step: moves the model to the expected state, and returns whether there is one. There
  /// `decide` is called, with the solver's increments being the expected ones; what it holds stays where it is put.
  bool move_to_expected_state(FENewtonSolver& solver, const std::function<void()>& decide);

  /// With the first matrix formed there: the right-hand side R(x + P) + theta K P. Nothing happens otherwise.
  void complete_residual(FENewtonSolver& solver);

 private:
  bool is_worth_trying() const;
  bool follows_the_change() const;
  bool loads_turn() const;

  FEModel& fem_;
  std::vector<mixture_contact::PastSteps> variables_;  ///< (degrees of freedom of the variable, nodes) each
  std::vector<mixture_contact::PastSteps> loads_;      ///< of each load controller, (1, 1)
  int analysis_step_ = -1;                             ///< whose steps those are
  std::vector<double> load_values_;    ///< of load controllers, at the end of the last step; empty before the first
  bool restored_ = false;              ///< since the last step that was solved
  bool ahead_ = false;                 ///< whether the present step began at the expected state
  int iterations_plain_ = 1;           ///< of the last step that did not
  double missed_ = 1;                  ///< of the last change, the largest part of a variable
  double missed_in_vain_ = 0;          ///< what was missed where to begin ahead saved no iteration
  std::vector<double> part_of_guess_;  ///< theta P, per equation; empty but for the first iteration of a step
};
