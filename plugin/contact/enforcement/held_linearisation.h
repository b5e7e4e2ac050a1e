/// A linearisation that is used in several iterations, for hosts that keep their matrix.
#pragma once

#include "enforcement/pass_parts.h"
#include "enforcement/virtual_work.h"

#include <variant>

namespace mixture_contact {

/// The loads from the linearisation of a pass: at the start of its iteration, and corrected for later iterations with
/// the same matrix.
class HeldLinearisation {
 public:
  /// Keeps a reference to the parts.
  explicit HeldLinearisation(PassParts& parts) : parts_(parts) {}

  // The pass that owns the linearisation calls the next four functions.
  /// Sets a new linearisation and keeps a reference to it. `begins`: true in the first iteration of a step.
  void replaced(LinearisationPoint& point, bool begins);
  /// Removes the linearisation.
  void ended();
  /// Sets the loads `before` the start of the iteration, at the same integration points; residual_change() evaluates
  /// the change.
  void follows(const NodalLoads& before);
  /// Discards the change of the loads after a motion of the surfaces.
  void moved() { change_ = {}; }

  /// True if the linearisation can be corrected: the host's matrix belongs to it, and loads are linear in gaps and
  /// jumps, which excludes friction and unknown multipliers.
  bool is_correctable() const;
  /// True if the next iteration can use the corrected linearisation. This requires that no node needs another status by
  /// more than the error of the loads, except nodes that can be released or added, and that the last correction reduced
  /// this error.
  bool serves(const FacingFields& fields) const;
  /// Begins an iteration with the corrected linearisation: gaps and jumps have their true values and keep their
  /// variations. Added nodes have the variations of this state. Returns true if loads change or differ from those of
  /// the matrix. If the linearisation cannot be corrected, no load changes.
  bool correct(const FacingFields& fields);

  /// Notes that the host has assembled its matrix with this linearisation. `has_loads`: true if nodal loads, except
  /// those on rigid bodies, are unknowns of the matrix, such that nodes can be released and added.
  void has_matrix(bool has_loads);
  /// Nodes whose loads are in the matrix but which are open: their loads do not depend on their gaps.
  IndexedVector<int> released() const { return linearised(false, false); }
  /// Nodes in contact whose loads are not in the matrix.
  IndexedVector<int> added() const { return linearised(true, true); }
  /// Calls `add` with the tangents of the loads of these nodes. The matrix does not contain these tangents.
  void add_loads(const IndexedVector<int>& nodes, double dt, const AddLoadBlock& add) const;

  // The following functions predict the status of nodes at the start of an iteration, by solutions with the host's
  // matrix.
  /// True if the status of nodes may be predicted with the matrix.
  bool may_decide() const;
  /// Linearises the open nodes that overlap after these displacements of the surfaces (see gap_changes()). Returns the
  /// newly linearised nodes. It finds none in the first iteration, because their loads would not be in the residual
  /// with which hosts compare later ones.
  NodeFlags find_nearing(const FacingPositions& displacements, const FacingFields& fields);
  /// Open nodes that are linearised but not in the matrix.
  IndexedVector<int> nearing() const { return linearised(false, true); }
  /// Tractions at this state of the nodes whose status may be predicted [MPa]: those of nodes in contact, and the trial
  /// loads of nearing() nodes; NaN at all other nodes.
  VectorXd undecided(const FacingFields& fields) const;
  /// The nodes that open at the start of the iteration. `tractions`: of the nodes in undecided(), at the end of the
  /// iteration [MPa] (see ActiveSet::opening()). `opened`: nodes that were assumed open for these tractions; they are
  /// returned if the matrix does not permit so many changes of status.
  NodeFlags opening(const VectorXd& tractions, const NodeFlags& opened) const;
  /// Opens these nodes and closes all other nearing() nodes. The resulting change of the loads at this state is the
  /// change at the start of the iteration.
  void open(const NodeFlags& nodes, const FacingFields& fields);

  /// Adds the residual of the change of the loads at the start of the iteration. Returns false if the integration
  /// points have changed as well; the sum is then invalid.
  ///
  /// Loads of a correction act through the virtual works of the tangent. A large penalty makes a large load of a small
  /// gap; with the works of the present state, this load would not cancel with the solution by the matrix.
  bool residual_change(const FacingFields& fields, double dt, const AddVector& add) const;

 private:
  /// No change.
  struct Nothing {};
  /// A change of the loads at the integration points of the present state.
  struct AtPoints {
    NodalLoads loads;
  };
  /// A change of the loads that act through the virtual works of the linearisation.
  struct ByWorks {
    NodalLoads loads;
  };
  /// Adds the residual of a change of the loads at the points of the iteration.
  void residual_of(const AtPoints& change, const FacingFields& fields, double dt, const AddVector& add) const;
  /// The loads of the true averages at a state.
  NodalLoads true_loads(const FacingFields& fields, ContactStatus status) const;
  /// The possible error of corrected tractions [MPa]: the remaining gaps times the stiffness of the adjoining elements,
  /// which does not depend on the penalty.
  double doubt(const NodalLoads& predicted, const NodalLoads& now) const;
  /// True if `status` differs from that of the matrix at no more than `most` nodes, all of which may be released or
  /// added.
  bool may_take(const NodeFlags& status, Index most) const;
  /// Begins an iteration in which no load changes.
  void keep() { change_ = Nothing(); }
  /// Nodes in contact in `status` that have no linearisation.
  NodeFlags unknown_of(const NodeFlags& status) const;
  /// True if some nodes of a patch are on rigid bodies, which have no equations of their own, such that its load cannot
  /// be an unknown of the matrix.
  bool is_of_rigid_bodies(const Patch& patch) const;
  /// The status with these nodes open, and all other nearing() nodes in contact.
  NodeFlags status_without(const NodeFlags& open) const;
  /// Linearises further nodes at the present positions of the surfaces.
  void linearise_more(const NodeFlags& nodes, const FacingFields& fields);
  /// Linearised nodes with this status. `is_added`: true for nodes that are not in the matrix.
  IndexedVector<int> linearised(bool in_contact, bool is_added) const;
  /// Sets the status that the loads require. Returns true if this has added nodes.
  bool change_status(const NodalLoads& predicted, const NodalLoads& now, const FacingFields& fields);

  PassParts& parts_;
  LinearisationPoint* point_ = nullptr;  ///< linearisation of the pass; null if there is none
  /// The change of the loads at the start of the iteration; std::monostate if it is unknown.
  std::variant<std::monostate, Nothing, AtPoints, ByWorks> change_;
  bool begins_ = false;  ///< true if the matrix belongs to the first iteration of the step
  /// Error of the tractions at the last correction [MPa]; 0 if there was none with this status.
  double last_error_ = 0;
  bool has_matrix_ = false;  ///< true if the host's matrix belongs to this linearisation
  bool has_loads_ = false;   ///< true if loads are unknowns of the host's matrix
  NodeFlags added_;          ///< per node: true if it was linearised after the matrix was assembled
};

}  // namespace mixture_contact
