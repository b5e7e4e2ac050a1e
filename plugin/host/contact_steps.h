/// The actions of a host on its contacts at each of the host's calls, by the phase of the solution (stepper.h).
///
/// A model has one ContactSteps for all its contacts. A host that notifies each contact of an event passes the contact
/// with the call; the first call of each event acts for all contacts.
#pragma once

#include "contact/interface/interface.h"
#include "solver/helper.h"
#include "stepper.h"

#include <vector>

namespace mixture_contact {

/// A contact at the present state of its model, as ContactSteps uses it. A host provides the core and the state; the
/// actions of the iterations are those of the core.
class SteppedContact : public Polymorphic {
 public:
  virtual ContactInterface& core() const = 0;
  /// Positions and fields at the nodes in the present state.
  virtual PerSide<SurfaceFields> fields() const = 0;
  /// Projects the integration points at the present positions.
  virtual void project() = 0;
  /// Prepares the contact for a new time step.
  virtual void prepare_step() {}
  /// Notes the status of the nodes with which the iterations have begun.
  virtual void note_beginning() {}

  /// Removes the linearisation of the iterations.
  virtual void end_iterations() { core().end_iterations(); }
  /// Begins a Newton iteration. Returns true if loads have changed.
  virtual bool begin_iteration() { return core().begin_iteration(fields()); }
  /// Sets the loads of the true laws at this state, without linearisation, for an evaluation that no matrix follows.
  virtual void hold_loads() { mixture_contact::hold_loads(core(), fields()); }
  /// Moves the linearisation point of the iteration to the present state.
  virtual void linearise_at() { core().linearise_at(fields()); }
  /// True if the next iteration can use the matrix of this one, with its linearisation corrected by correct().
  virtual bool keeps_matrix();
  /// Begins an iteration with the present linearisation, after gaps and jumps have been set to their true values.
  /// Returns true if loads change.
  virtual bool correct();
  /// True if the state is a solution of the contact laws.
  virtual bool is_solution() { return core().is_solution(fields()); }
  /// True if the state has edge nodes that have to be tried once more; it is not a solution then.
  virtual bool reconsiders_edge() { return mixture_contact::reconsiders_edge(core(), fields()); }
  /// True if bonds hold the surfaces, which breaks_bonds() may break.
  virtual bool has_bonds() const { return false; }
  /// Breaks bonds at a state. `left`: fraction of the change of their loads in the last iteration by which iterations
  /// may still change them, 0 at a solution [-]. Returns true if any breaks; iterations then begin again at this state.
  virtual bool breaks_bonds(double /*left*/) { return false; }
  /// True if overlaps that are detected at a converged state change the loads.
  virtual bool finds_overlap();

 protected:
  /// Writes an overlap that is detected for the first time in a run to the log.
  virtual void report(const UndetectedPenetration& undetected) = 0;

 private:
  bool said_overlap_ = false;  ///< true if an overlap has been reported in this run
};

/// The matrices of the host's solution method.
enum class MatrixUse {
  each_iteration,  ///< full Newton: a new matrix in each iteration
  kept,            ///< quasi-Newton, modified Newton: several iterations use one matrix
  none             ///< matrix-free: differences of residuals replace products with the tangent
};

/// The model of the contacts, as ContactSteps uses it.
class SteppedModel {
 public:
  SteppedModel() = default;
  SteppedModel(const SteppedModel&) = delete;
  SteppedModel& operator=(const SteppedModel&) = delete;
  SteppedModel(SteppedModel&&) = delete;
  SteppedModel& operator=(SteppedModel&&) = delete;
  virtual ~SteppedModel() = default;

  /// The contacts that are active in the present step.
  virtual std::vector<SteppedContact*> active_contacts() = 0;
  /// Sets nodes out of contact to ambient values and frees all others. Returns true if any value or node has changed.
  virtual bool apply_ambient() = 0;
  /// Evaluates bodies and contacts at the present state; this calls ContactSteps::evaluate().
  virtual void evaluate() = 0;
  /// Requests another evaluation of the bodies after that of the contacts, during an evaluation.
  virtual void evaluate_bodies_after_contacts() = 0;
  /// Evaluates the residual again, or the part of it that has changed.
  virtual void evaluate_residual(Changed what) = 0;
  /// Corrects the host's residual and matrix after contacts have corrected their linearisations: for the changed loads,
  /// and for nodes that have opened or closed.
  virtual void correct_residual() = 0;
  /// The use of matrices in the present step.
  virtual MatrixUse matrix_use() = 0;
  /// True if the host's limit on the number of iterations with one matrix is reached.
  virtual bool is_matrix_due() = 0;
  /// Called when an iteration has ended and the next one would keep the matrix. Assembles a new matrix at this state if
  /// too much of the residual remains, and returns true if it has.
  virtual bool replaces_matrix() = 0;
  /// Requests a new matrix for the next iteration, or withdraws the request.
  virtual void request_matrix(bool is_needed) = 0;
  /// Reports that a converged state has been rejected for the n-th time in a step.
  virtual void rejected(int n, GoesOn with) = 0;
  /// Reports that a converged state has been accepted.
  virtual void accepted() = 0;
};

/// Performs the actions of a model's contacts at each call of the host.
class ContactSteps {
 public:
  /// `helpers`: the helpers of the solver, if any.
  explicit ContactSteps(SteppedModel& model, newton::Helpers helpers = {})
      : model_(model), helpers_(std::move(helpers)) {}

  /// Begins the iterations of a contact that has become active, at the present state.
  void activate(SteppedContact& contact);
  /// Resets the detection of repeated calls, because the set of active contacts has changed or a step begins.
  void reset_rounds();

  // Calls that a host makes for each contact; `told` identifies the contact.
  /// Prepares all contacts for a step. Returns true at the first call of an event.
  bool prepare_step(const void* told);
  /// Evaluates all contacts at the present state.
  void evaluate(const void* told);
  /// Notes that the host has set a trial state by this increment.
  void try_increment(const void* told, const std::vector<double>& increment);
  /// Begins an iteration if the host is about to assemble a matrix.
  void before_matrix();
  /// Decides at a converged state of the host. Returns true if the state is accepted as a solution.
  bool accepts(const void* told);

  // Calls that a host makes once for the model.
  /// Notes that the host has assembled a matrix.
  void matrix_formed();
  /// Notes that an iteration has ended and that the host continues.
  void end_iteration();
  void end_step() { helpers_.end_step(); }
  newton::Helpers& helpers() { return helpers_; }
  const newton::Helpers& helpers() const { return helpers_; }
  /// Notes that the state at the start of a failed attempt has been restored.
  void rewind();
  /// Notes that a run is continued from a restart file.
  void restart();

  /// True if matrices may have further unknowns that depend on nodal values.
  bool allow_further_unknowns() const { return !helpers_.multiply_by_matrix(); }
  /// True if an iteration has begun at the present state, such that only the matrix has to be assembled.
  bool has_begun() const { return stepper_.phase() == Phase::begun || stepper_.phase() == Phase::step_prepared; }

 private:
  /// The parts of the model that change at the start of an iteration.
  struct Changes {
    bool loads;   ///< loads of contacts
    bool values;  ///< nodal values, on which the bodies depend
    Changed kind() const;
  };
  Changes begin_iteration();
  /// True if iterations linearise the contact, for a matrix.
  bool linearises() const { return model_.matrix_use() != MatrixUse::none; }
  void evaluate_again();
  void bring_residual_up_to_date();
  void start_at_prediction();
  bool breaks_bonds();
  bool keeps_matrix();
  bool is_solution();

  SteppedModel& model_;
  newton::Helpers helpers_;
  Stepper stepper_;
  Round evaluations_;
  Round trials_;
  Round preparations_;
  Round convergences_;
};

}  // namespace mixture_contact
