/// A model in a run: its current state, loads and conditions.
#pragma once

#include "contact.h"
#include "linear_system.h"
#include "tied_contact.h"

namespace standalone {

/// Bodies, contacts and conditions with the current nodal values.
///
/// Vectors have one entry per nodal value (see Model::place), including values that are not unknowns.
class Problem {
 public:
  /// Throws InputError if a rigid body is not fixed, or if there is no unknown. Conditions on fields that no element
  /// has are ignored.
  explicit Problem(const Model& model);

  const Model& model() const { return bodies_.model(); }
  const Bodies& bodies() const { return bodies_; }
  std::vector<Contact>& contacts() { return contacts_; }
  const std::vector<TiedContact>& ties() const { return ties_; }
  /// The current u [mm], p~ [MPa] and c~ [mM], shape (dofs, nodes).
  const MatrixXd& values() const { return state_.values; }
  /// The reaction forces at prescribed displacements from the last residual(), except at fixed ones, for which FEBio
  /// reports none; shape (3, nodes).
  Matrix3Xd reactions() const;
  /// Per nodal value, true if it is an unknown now: neither prescribed nor ambient.
  std::vector<bool> free() const;

  /// Sets the reduction of automatic traction penalties from the next step on.
  void reduce_penalties(const mixture_contact::ReducedPenalty& reduction) { reduction_ = reduction; }
  /// Starts a time step of length `dt` that ends at `time` [s].
  void start_step(double time, double dt);
  /// Stores the current state as the start of the next step.
  void accept_step();
  double time_increment() const { return dt_; }

  /// Sets nodes out of contact to ambient values, and frees the other nodes. Returns true if anything changed.
  bool switch_ambient();
  /// Adds `change` and the pending increments to the nodal values.
  void advance(const VectorXd& change);
  /// Prescribed increments that have not been added to the nodal values.
  const VectorXd& pending() const { return pending_; }

  /// The forces at unknown nodal values; zero in equilibrium. Throws StepFailure if an element is inverted or a force
  /// is not finite.
  VectorXd residual();
  /// Assembles the tangent -d residual/d values.
  void assemble(LinearSystem& system) const;

  /// The status of a nodal value: without a field, prescribed, ambient (at a node out of contact), or unknown.
  enum class Status : unsigned char { absent, prescribed, ambient, free };

  /// All data that change in a time step, to repeat the step.
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

  Bodies bodies_;
  std::vector<Contact> contacts_;
  std::vector<TiedContact> ties_;
  std::vector<MatrixXd> unit_forces_;  ///< nodal forces of each load for a value of 1
  State state_;
  VectorXd pending_;
  VectorXd forces_;  ///< forces of the last residual() at all nodal values
  double time_ = 0, dt_ = 0;
  mixture_contact::ReducedPenalty reduction_;
};

}  // namespace standalone
