/// Newton's method for one time step, with FEBio's line search and convergence tests.
#pragma once

#include "log.h"
#include "problem.h"

namespace standalone {

/// How much work was done.
struct Effort {
  int iterations = 0;
  int reformations = 0;
  int residuals = 0;

  void operator+=(const Effort& other);
};

/// Full Newton: the matrix is formed anew in each iteration, contact status changes between iterations only, and what
/// converged counts as a solution only if the status agrees with it and the augmentations are done.
class Newton {
 public:
  Newton(Problem& problem, Log& log);

  /// Solves the step from the current state to `time`. Throws StepFailure where it does not converge.
  void solve_step(double time, double dt);

  /// What the last step took, also if it failed.
  const Effort& effort() const { return effort_; }

 private:
  /// Squared norms of displacements, pressures and each concentration in a vector over the equations.
  VectorXd field_norms(const VectorXd& vector) const;
  /// Matrix and residual of the state at which an iteration has begun; the residual is known if `evaluated`.
  void form_matrix(bool evaluated);
  void evaluate(const VectorXd& trial);
  double line_search(const VectorXd& change);
  bool converged(const VectorXd& change, double step, double time);
  void restart_norms_if_diverging(const VectorXd& change, double step);
  bool augment();
  bool augment(Contact& contact);
  void log_norms(double time, double step, double residual, double energy, const VectorXd& fields,
                 const VectorXd& allowed) const;

  Problem& problem_;
  Log& log_;
  const Control& control_;
  LinearSystem system_;
  Effort effort_;
  int allowed_reformations_ = 0;  ///< left until the step counts as failed
  int augmentations_ = 0;
  VectorXd start_, end_;  ///< residual before and after an iteration
  double first_residual_ = 0, first_energy_ = 0, largest_energy_ = 0;
  VectorXd first_fields_;
  VectorXd increment_;  ///< of the step so far
};

}  // namespace standalone
