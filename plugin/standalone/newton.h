/// Newton's method for one time step, with FEBio's convergence tests.
#pragma once

#include "log.h"
#include "problem.h"

#include <set>

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
  /// What the convergence tests compare: squared norms, those of fields for displacement, pressure and each
  /// concentration.
  struct Norms {
    double residual = 0;
    double energy = 0;
    VectorXd fields;
  };
  Norms norms(const VectorXd& residual, const VectorXd& change) const;

  void evaluate();
  /// Matrix and residual of the state at which an iteration has begun; the residual is known if `evaluated`.
  void form_matrix(bool evaluated);
  bool converged(const Norms& now, double time);
  void log_norms(const Norms& now, const Norms& required, double time) const;
  bool augment();
  /// Whether the iterations go on with nodes that a second pass has just noticed.
  bool notices_overlap(const Contact& contact);

  Problem& problem_;
  Log& log_;
  const Control& control_;
  LinearSystem system_;
  Effort effort_;
  int allowed_reformations_ = 0;  ///< left until the step counts as failed
  int augmentations_ = 0;
  VectorXd start_, end_;  ///< residual before and after an iteration
  Norms first_;
  VectorXd increment_;                     ///< of the step so far
  std::set<const Contact*> said_noticed_;  ///< whose first noticed nodes the log has named
};

}  // namespace standalone
