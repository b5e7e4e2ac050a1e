/// The phases of a contact between the calls of its host: time steps, iterations, trial states, augmentations.
///
/// A host solves a step by Newton's method. The contacts of its model are in one of the following phases between two
/// calls, and the phase determines the meaning of a call. Stepper does not depend on the host: it receives events and
/// returns actions.
///
///     converged ---evaluate---> begun ---prepare_step---> step_prepared
///     begun, step_prepared, evaluated, uncorrected ---form_matrix---> forming, forming_loads, forming_anew
///     any ---try_state---> trial ---evaluate---> evaluated
///     evaluated, uncorrected ---keep_matrix---> corrected
///     evaluated ---reject---> rejected ---evaluate---> begun
///     evaluated ---reject---> uncorrected
///     evaluated ---accept---> converged
///     any ---rewind---> converged
#pragma once

#include <set>

namespace mixture_contact {

/// The phases of the contacts.
enum class Phase {
  converged,      ///< no linearisation is kept; a step, or the iterations after an augmentation, may begin
  begun,          ///< an iteration has begun at this state
  step_prepared,  ///< an iteration has begun at this state, the first one of a time step
  forming,        ///< a matrix is assembled; the host's residual is that of this state
  forming_loads,  ///< a matrix is assembled; loads of contacts have changed since the host evaluated its residual
  /// A matrix is assembled; nodal values, on which the bodies depend, have changed since the host evaluated its
  /// residual.
  forming_anew,
  trial,      ///< a trial state is set but not evaluated; the active set is constant
  evaluated,  ///< a trial state has been evaluated
  rejected,   ///< the host has converged at a state that the contacts reject; a new matrix follows
  /// The host has converged at a state that the contacts reject; the corrected linearisation is used again.
  uncorrected,
  corrected  ///< an iteration has begun with the matrix and the linearisation of the last one
};

/// The matrix of the iteration after a rejected convergence.
enum class GoesOn {
  matrix,     ///< a new matrix
  correction  ///< the present matrix, with its linearisation corrected
};

/// The parts of the model that have changed since the host evaluated its residual: nothing, loads of contacts, or also
/// nodal values.
enum class Changed { nothing, loads, all };

/// The present phase of the contacts, and the actions that follow from the events of the host.
class Stepper {
 public:
  /// The action of the contacts when the model is evaluated.
  enum class Evaluation {
    keep_active_set,  ///< after a trial: no status changes
    begin_anew,  ///< at the start of a step or after an augmentation: remove the linearisation and begin an iteration
    go_on,       ///< after a rejected convergence: begin an iteration from the prediction of the last one
    keep_linearisation  ///< after a rejected convergence: the iteration continues with the present linearisation
  };
  /// The model is evaluated. Returns the action.
  Evaluation evaluate();

  /// A time step begins at the state that was just evaluated.
  void prepare_step();

  /// A trial state has been set.
  void try_state() { phase_ = Phase::trial; }

  /// The action before a matrix is assembled.
  enum class Matrix {
    predict,   ///< the first matrix of a step: a predictor may change the state
    nothing,   ///< an iteration has already begun at this state
    begin,     ///< the last trial state is accepted: begin an iteration
    is_formed  ///< the assembly has been announced already
  };
  /// The action before a matrix is assembled.
  Matrix before_matrix() const;
  /// A matrix is assembled. `changed`: parts of the model that have changed since the host evaluated its residual.
  void form_matrix(Changed changed);
  /// A matrix has been assembled. Returns the part of the residual that the host has to evaluate again.
  Changed matrix_formed();

  /// The host continues from the last trial state. Returns true if it keeps its matrix.
  bool keep_matrix();

  /// The contacts accept the state at which the host has converged, or augment at it.
  void accept() { phase_ = Phase::converged; }
  /// The contacts reject the state at which the host has converged. Returns the number of rejections in this step.
  int reject(GoesOn with);

  /// The state of an earlier time has been restored.
  void rewind() { phase_ = Phase::converged; }

  Phase phase() const { return phase_; }

 private:
  Phase phase_ = Phase::converged;
  int rejections_ = 0;  ///< number of rejections in this step
};

/// Recognises whether a host notifies further contacts of the same event, or of the next event: a new event begins when
/// a contact is notified for the second time.
class Round {
 public:
  /// True if the notification of this participant is the first one of an event.
  bool opens(const void* participant);
  void reset() { told_.clear(); }

 private:
  std::set<const void*> told_;
};

}  // namespace mixture_contact
