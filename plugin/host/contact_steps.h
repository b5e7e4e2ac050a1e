/// The actions of a host of contacts at each call, by the phase that it is in (stepper.h).
///
/// There is one for a model, and it acts on all contacts of the model: hosts that inform each contact of a call pass
/// on which one it is, and the first one to be called does it for all.
#pragma once

#include "solver/helper.h"
#include "stepper.h"

#include <vector>

namespace mixture_contact {

/// A contact, at the present state of its model.
class SteppedContact {
 public:
  SteppedContact() = default;
  SteppedContact(const SteppedContact&) = delete;
  SteppedContact& operator=(const SteppedContact&) = delete;
  SteppedContact(SteppedContact&&) = delete;
  SteppedContact& operator=(SteppedContact&&) = delete;
  virtual ~SteppedContact() = default;

  virtual void project() = 0;
  virtual void prepare_step() = 0;
  virtual void end_iterations() = 0;
  /// Returns whether loads have changed.
  virtual bool begin_iteration() = 0;
  /// Holds loads of the true laws at this state, without their linearisation, for an evaluation that no matrix follows.
  virtual void hold_loads() = 0;
  virtual void linearise_at() = 0;
  /// Whether the next iteration can use the matrix of this one, with its linearisation corrected by correct().
  virtual bool keeps_matrix() = 0;
  /// Begins an iteration with the linearisation that is held: its gaps and jumps take their true values.
  /// Returns whether loads change.
  virtual bool correct() = 0;
  virtual bool is_solution() = 0;
  /// Whether a state has edge nodes that have to be tried once more; it is no solution then.
  virtual bool reconsiders_edge() = 0;
  /// Whether overlaps detected at a converged state change the loads.
  virtual bool finds_overlap() = 0;
};

/// How a host's method uses matrices.
enum class MatrixUse {
  each_iteration,  ///< full Newton: a new one for each
  kept,            ///< quasi-Newton, modified Newton: several iterations use one
  none             ///< products with the tangent are differences of residuals
};

/// The model that the contacts are in.
class SteppedModel {
 public:
  SteppedModel() = default;
  SteppedModel(const SteppedModel&) = delete;
  SteppedModel& operator=(const SteppedModel&) = delete;
  SteppedModel(SteppedModel&&) = delete;
  SteppedModel& operator=(SteppedModel&&) = delete;
  virtual ~SteppedModel() = default;

  virtual std::vector<SteppedContact*> active_contacts() = 0;
  /// Sets nodes outside all contacts to ambient values and frees the others. Returns whether anything changed.
  virtual bool apply_ambient() = 0;
  /// Evaluates bodies and contacts at the present state, by way of ContactSteps::evaluate().
  virtual void evaluate() = 0;
  /// Requests an evaluation of the bodies after the contacts, within an evaluation.
  virtual void evaluate_bodies_after_contacts() = 0;
  /// Evaluates the residual again, or its changed parts.
  virtual void evaluate_residual(Changed what) = 0;
  /// Contacts have corrected their linearisations. Corrects the host's residual and matrix for their loads, and for
  /// nodes that have opened or closed.
  virtual void correct_residual() = 0;
  virtual MatrixUse matrix_use() = 0;
  /// Whether as many iterations have been corrected with one matrix as the host's limit on them allows.
  virtual bool is_matrix_due() = 0;
  /// An iteration has ended, and the next one keeps the matrix. If too much of the residual remains, the host forms a
  /// new matrix at this state. Returns whether it has.
  virtual bool replaces_matrix() = 0;
  /// Says whether the next iteration needs a matrix of its own.
  virtual void request_matrix(bool is_needed) = 0;
  /// A converged state has been rejected for the n-th time in a step.
  virtual void rejected(int n, GoesOn with) = 0;
  virtual void accepted() = 0;
};

class ContactSteps {
 public:
  ContactSteps(SteppedModel& model, newton::Helpers& helpers) : model_(model), helpers_(helpers) {}

  /// A contact has become active: its iterations begin at the present state.
  void activate(SteppedContact& contact);
  /// The set of active contacts has changed, or a step begins: no call is under way.
  void reset_rounds();

  // Calls that a host makes for each contact
  /// Returns whether this contact is the first one to be called.
  bool prepare_step(const void* told);
  void evaluate(const void* told);
  void try_increment(const void* told, const std::vector<double>& increment);
  void before_matrix();
  /// The host has converged. Returns whether the state is accepted as a solution.
  bool accepts(const void* told);

  // Calls for the model
  void matrix_formed();
  /// An iteration of a host has ended, and the host continues.
  void end_iteration();
  void end_step() { helpers_.end_step(); }
  /// The state at the start of a failed attempt has been restored.
  void rewind();
  /// A run is continued.
  void restart();

  /// Whether matrices may have further unknowns that follow nodal values.
  bool allow_further_unknowns() const { return !helpers_.multiply_by_matrix(); }
  /// Whether an iteration has begun at the present state, so that nothing but the matrix is left to do.
  bool has_begun() const { return stepper_.phase() == Phase::begun || stepper_.phase() == Phase::step_prepared; }

 private:
  /// The changes at the start of an iteration.
  struct Changes {
    bool loads;   ///< of contacts
    bool values;  ///< at nodes, which the bodies depend on
    Changed kind() const;
  };
  Changes begin_iteration();
  void evaluate_again();
  void bring_residual_up_to_date();
  void start_at_prediction();
  bool keeps_matrix();
  bool is_solution();

  SteppedModel& model_;
  newton::Helpers& helpers_;
  Stepper stepper_;
  Round evaluations_;
  Round trials_;
  Round preparations_;
  Round convergences_;
};

}  // namespace mixture_contact
