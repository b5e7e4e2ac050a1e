/// Newton's method for one time step, with FEBio's convergence tests.
#pragma once

#include "host/contact_steps.h"
#include "log.h"
#include "problem.h"

#include <memory>
#include <vector>

namespace standalone {

/// Numbers of iterations, matrices and residual evaluations.
struct Effort {
  int iterations = 0;
  int reformations = 0;
  int residuals = 0;

  void operator+=(const Effort& other);
};

/// Full Newton's method: each iteration assembles the matrix, and the contact status changes only between iterations. A
/// converged state is a solution if the contact status agrees with it and no augmentation is needed.
class Newton : private mixture_contact::SteppedModel {
 public:
  Newton(Problem& problem, Log& log);

  /// Decides at the current state which nodes are in contact and which have ambient values.
  void begin() { steps_.evaluate(this); }

  /// Solves the step from the current state to `time` [s] with the increment `dt` [s]. Throws StepFailure if it does
  /// not converge.
  void solve_step(double time, double dt);

  /// Notes that the state at the start of the step has been restored.
  void rewind() { steps_.rewind(); }

  /// The effort of the last step, which may have failed.
  const Effort& effort() const { return effort_; }

 private:
  /// The squared norms in the convergence tests. `fields`: displacement, pressure, then each concentration.
  struct Norms {
    double residual = 0;
    double energy = 0;
    VectorXd fields;
  };
  const Control& control() const { return problem_.model().control; }
  Norms norms(const VectorXd& residual, const VectorXd& change) const;

  /// Assembles the matrix at the current state, and evaluates the residual unless `evaluated` is true and contact has
  /// not changed it.
  void form_matrix(bool evaluated);
  bool converged(const Norms& now, double time);
  void log_norms(const Norms& now, const Norms& required, double time) const;
  bool augment();

  std::vector<mixture_contact::SteppedContact*> active_contacts() override;
  bool apply_ambient() override { return problem_.switch_ambient(); }
  bool replaces_matrix() override { return false; }
  void evaluate() override { steps_.evaluate(this); }
  void evaluate_bodies_after_contacts() override {}  // bodies are evaluated with the residual
  void evaluate_residual();
  void evaluate_residual(mixture_contact::Changed what) override;
  void correct_residual() override { evaluate_residual(); }
  mixture_contact::MatrixUse matrix_use() override { return mixture_contact::MatrixUse::each_iteration; }
  bool is_matrix_due() override { return false; }
  void request_matrix(bool /*is_needed*/) override {}
  void rejected(int /*n*/, mixture_contact::GoesOn /*with*/) override {}  // the limit on reformations holds
  void accepted() override {}

  Problem& problem_;
  Log& log_;
  LinearSystem system_;
  Effort effort_;
  int allowed_reformations_ = 0;  ///< number of matrices that may still be assembled in the step
  int augmentations_ = 0;
  VectorXd start_, end_;  ///< residual before and after an iteration
  /// Norms in the first iteration.
  Norms first_;
  VectorXd increment_;  ///< total increment of the step
  std::vector<std::unique_ptr<mixture_contact::SteppedContact>> contacts_;
  mixture_contact::ContactSteps steps_;
};

}  // namespace standalone
