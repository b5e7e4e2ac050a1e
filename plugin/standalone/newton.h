/// Newton's method for one time step, with FEBio's convergence tests.
#pragma once

#include "host/contact_steps.h"
#include "log.h"
#include "problem.h"

#include <memory>
#include <vector>

namespace standalone {

/// How much work was done.
struct Effort {
  int iterations = 0;
  int reformations = 0;
  int residuals = 0;

  void operator+=(const Effort& other);
};

/// Full Newton: the matrix is formed in each iteration, contact status changes between iterations only, and a converged
/// state counts as a solution only if the status agrees with it and the augmentations are done.
class Newton : private mixture_contact::SteppedModel {
 public:
  Newton(Problem& problem, Log& log);

  /// Decides which nodes are in contact or have ambient values at the current state.
  void begin() { steps_.evaluate(this); }

  /// Solves the step from the current state to `time`. Throws StepFailure if it does not converge.
  void solve_step(double time, double dt);

  /// The state of the start of a step has been restored.
  void rewind() { steps_.rewind(); }

  /// The effort of the last step, also if it failed.
  const Effort& effort() const { return effort_; }

 private:
  /// The squared norms that the convergence tests compare, those of fields for displacement, pressure and each
  /// concentration.
  struct Norms {
    double residual = 0;
    double energy = 0;
    VectorXd fields;
  };
  Norms norms(const VectorXd& residual, const VectorXd& change) const;

  /// Matrix and residual of the current state; the latter is known already if `evaluated`, unless contact changes it.
  void form_matrix(bool evaluated);
  bool converged(const Norms& now, double time);
  void log_norms(const Norms& now, const Norms& required, double time) const;
  bool augment();

  std::vector<mixture_contact::SteppedContact*> active_contacts() override;
  bool apply_ambient() override { return problem_.switch_ambient(); }
  bool replaces_matrix() override { return false; }
  void evaluate() override { steps_.evaluate(this); }
  void evaluate_bodies_after_contacts() override {}  // they are evaluated with the residual
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
  const Control& control_;
  LinearSystem system_;
  Effort effort_;
  int allowed_reformations_ = 0;  ///< left until the step counts as failed
  int augmentations_ = 0;
  VectorXd start_, end_;  ///< residual before and after an iteration
  Norms first_;
  VectorXd increment_;  ///< of the step so far
  std::vector<std::unique_ptr<mixture_contact::SteppedContact>> contacts_;
  newton::Helpers no_helpers_;
  mixture_contact::ContactSteps steps_;
};

}  // namespace standalone
