/// A model in a run: its current state, loads and conditions.
#pragma once

#include "contact.h"
#include "linear_system.h"
#include "tied_contact.h"

namespace standalone {

/// Bodies, contacts and conditions with the current nodal values.
///
/// Vectors have one entry per place of a nodal value (see Model::place), whether it is unknown or not.
class Problem {
 public:
  /// Throws InputError if a rigid body is not held, or nothing is free. Conditions where no element has the field
  /// are void.
  explicit Problem(const Model& model);

  const Model& model() const { return model_; }
  const Bodies& bodies() const { return bodies_; }
  std::vector<Contact>& contacts() { return contacts_; }
  const std::vector<TiedContact>& ties() const { return ties_; }
  /// Current u [mm], p~ [MPa] and c~ [mM], shape (dofs, nodes).
  const MatrixXd& values() const { return state_.values; }
  /// Forces that the last residual() left on prescribed displacements, where a condition reports them; shape (3,
  /// nodes).
  Matrix3Xd reactions() const;
  /// Whether each dof of each node holds an unknown now: its value is neither prescribed nor ambient.
  std::vector<bool> free() const;

  /// Has automatic penalties of the traction reduced so from the next step on.
  void reduce_penalties(const mixture_contact::ReducedPenalty& reduction) { reduction_ = reduction; }
  /// Starts a time step that ends at `time` [s].
  void start_step(double time, double dt);
  /// Keeps the current state as the start of the next step.
  void accept_step();
  double time_increment() const { return dt_; }

  /// Switches nodes outside contact to ambient values, and frees the others. Returns whether anything changed.
  bool switch_ambient();
  /// Adds a change and the pending changes to the nodal values.
  void advance(const VectorXd& change);
  /// Prescribed increments that are not yet in the nodal values.
  const VectorXd& pending() const { return pending_; }

  /// Forces on the free places; zero in equilibrium. Throws StepFailure if an element is inverted or a force not
  /// finite.
  VectorXd residual();
  /// Assembles the tangent, -d residual/d values.
  void assemble(LinearSystem& system) const;

  /// The kind of a value: none, prescribed, the ambient one at a node that is not in contact,
  /// or unknown.
  enum class Status : unsigned char { absent, prescribed, ambient, free };

  /// Everything that changes in a time step, to try one again.
  struct State {
    MatrixXd values;
    std::vector<Status> status;
    std::vector<mixture_contact::ContactInterface::State> contacts;
    std::vector<mixture_contact::TieState> ties;
  };
  State save();
  void restore(const State& state);

 private:
  bool switch_ambient(int node, bool in_contact, const ContactDefinition& contact);
  VectorXd on_free_places(VectorXd forces) const;

  const Model& model_;
  Bodies bodies_;
  std::vector<Contact> contacts_;
  std::vector<TiedContact> ties_;
  std::vector<MatrixXd> unit_forces_;  ///< per load
  State state_;
  VectorXd pending_;
  VectorXd forces_;  ///< of the last residual(), on all places
  double time_ = 0, dt_ = 0;
  mixture_contact::ReducedPenalty reduction_;
};

}  // namespace standalone
