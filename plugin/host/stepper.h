/// The order of a host's calls around a contact: time steps, iterations, trials, augmentations.
///
/// A host solves a step by Newton's method. The contacts of its model are in one of a few phases between two of its
/// calls, and the phase alone decides the meaning of a call. The machine knows no host: it receives events and returns
/// actions.
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

enum class Phase {
  converged,      ///< nothing is held: a step, or the iterations after an augmentation, may begin
  begun,          ///< an iteration has begun at this state
  step_prepared,  ///< as `begun`, in the first iteration of a time step
  forming,        ///< a matrix is formed; the host's residual is that of this state
  forming_loads,  ///< a matrix is formed; loads of contacts have changed since the host evaluated its residual
  forming_anew,   ///< a matrix is formed; values have changed since, that the bodies depend on, too
  trial,          ///< a trial state is set, but not evaluated yet; the active set is held
  evaluated,      ///< a trial state has been evaluated
  rejected,       ///< the host has converged at a state that the contacts reject
  uncorrected,    ///< as `rejected`, with the held linearisation corrected and used again
  corrected       ///< an iteration has begun with the matrix and the linearisation of the last one
};

/// The start of the iteration after a rejected convergence.
enum class GoesOn {
  matrix,     ///< a new matrix
  correction  ///< the earlier matrix, with its linearisation corrected
};

/// The part of the model that has changed since the host evaluated its residual.
enum class Changed { nothing, loads, all };

class Stepper {
 public:
  /// The actions of an evaluation of the model.
  enum class Evaluation {
    keep_active_set,    ///< of a trial: nothing changes
    begin_anew,         ///< a step or an augmentation: drop the held linearisation, and begin an iteration
    go_on,              ///< convergence was rejected: begin an iteration from the prediction of the last one
    keep_linearisation  ///< convergence was rejected: the iteration continues with the held linearisation
  };
  Evaluation evaluate();

  /// A time step begins at the state that has just been evaluated.
  void prepare_step();

  /// A trial state has been set.
  void try_state() { phase_ = Phase::trial; }

  /// The actions before a matrix is formed.
  enum class Matrix {
    predict,   ///< the first one of a step: a predictor may move the model
    nothing,   ///< an iteration has begun at this state already
    begin,     ///< the state of the last trial is accepted: begin an iteration
    is_formed  ///< the host has been informed already
  };
  Matrix before_matrix() const;
  /// The matrix is formed now.
  void form_matrix(Changed changed);
  /// The matrix has been formed. Returns the part of the host's residual that has to be evaluated again.
  Changed matrix_formed();

  /// The host continues from the state of the last trial. Returns whether it keeps its matrix.
  bool keep_matrix();

  /// The contacts accept the state at which the host has converged, or augment there.
  void accept() { phase_ = Phase::converged; }
  /// The contacts reject the state at which the host has converged. Returns the number of rejections in this step.
  int reject(GoesOn with);

  /// The state of an earlier time has been restored.
  void rewind() { phase_ = Phase::converged; }

  Phase phase() const { return phase_; }

 private:
  Phase phase_ = Phase::converged;
  int rejections_ = 0;  ///< in this step
};

/// Distinguishes a host that informs several participants of one event, one after the other, from a host that informs
/// them of the next event: a round ends where a participant is informed again.
class Round {
 public:
  /// Whether this participant is the first one to be informed.
  bool opens(const void* participant);
  void reset() { told_.clear(); }

 private:
  std::set<const void*> told_;
};

}  // namespace mixture_contact
