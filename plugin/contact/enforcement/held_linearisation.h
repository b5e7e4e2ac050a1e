/// A linearisation that several iterations use, for hosts that keep their matrix.
#pragma once

#include "active_set/active_set.h"
#include "enforcement/virtual_work.h"

#include <variant>

namespace mixture_contact {

/// The uses that a host has for its matrix in addition to solving with it.
struct HostMatrix {
  bool has_loads = false;    ///< loads at nodes, except those on rigid bodies, are unknowns of the matrix: nodes can be
                             ///< released, and others added
  NodeFlags rigid;           ///< nodes of rigid bodies, whose displacements have no equations of their own
  NodeFlags rigid_opposite;  ///< the same on the surface that faces the one integrated over
};

/// The loads by the linearisation that a geometry holds: at the start of its iteration, and corrected for later
/// iterations.
class HeldLinearisation {
 public:
  /// Keeps references.
  HeldLinearisation(const MortarSpace& space, const NodalLaws& laws, ActiveSet& active_set,
                    const EnforcementMethod& method)
      : space_(space), laws_(laws), active_set_(active_set), method_(method) {}

  // The data that the geometry passes on
  /// The geometry has a new linearisation; keeps a reference. `begins`: no iteration before it is known.
  void replaced(LinearisationPoint& point, bool begins);
  /// The geometry has dropped its linearisation.
  void ended();
  /// Sets the loads at which the iteration of this linearisation began, at the same points.
  void follows(const NodalLoads& before);
  /// The surfaces have moved since the last call.
  void moved() { change_ = {}; }

  /// Whether the linearisation can be corrected: the host's matrix must belong to it, and loads must be linear in gaps
  /// and jumps. Friction and unknown multipliers rule this out.
  bool is_correctable() const;
  /// Whether the next iteration can use the corrected linearisation. No node may need another status by more than the
  /// error of the loads, except one that can be released or added, and the last correction must have reduced this
  /// error.
  bool serves(const FacingFields& fields) const;
  /// Begins an iteration with the corrected linearisation: gaps and jumps take their true values and keep their
  /// variations. Added nodes have the variations of this state. Returns whether loads change or differ from those of
  /// the matrix.
  bool correct(const FacingFields& fields);
  /// Begins an iteration without a correction: no load changes.
  void keep() { change_ = Nothing(); }

  /// The host has formed its matrix of this linearisation.
  void has_matrix(HostMatrix matrix);
  /// Nodes in contact in the matrix and open in the status: their loads do not follow their gaps.
  IndexedVector<int> released() const { return linearised(false, false); }
  /// Nodes in contact in the status and open in the matrix.
  IndexedVector<int> added() const { return linearised(true, true); }
  /// Adds the tangents of loads that the matrix lacks, at linearised nodes.
  void add_loads(const IndexedVector<int>& nodes, double dt, const AddLoadBlock& add) const;

  // Decisions on the nodes that an iteration begins in contact with, by solutions with the host's matrix
  /// Whether the matrix may change their status. It may not if an iteration begins with foreseen nodes: more change
  /// in the next one all the same, and each that changes costs a back substitution.
  bool may_decide() const;
  /// Linearises nodes out of contact that overlap once the surfaces have moved by these displacements (see
  /// gap_changes()). Returns the newly linearised nodes; none at the start of the iterations, because their pull would
  /// be no part of the residual that hosts compare later ones with.
  NodeFlags find_nearing(const FacingPositions& displacements, const FacingFields& fields);
  /// Open nodes that are linearised but not in the matrix.
  IndexedVector<int> nearing() const { return linearised(false, true); }
  /// Tractions at this state of nodes whose status the matrix may change [MPa]: of those in contact that it has, and of
  /// those that are nearing, were they in contact; NaN at all others.
  VectorXd undecided(const FacingFields& fields) const;
  /// Nodes that open as the iteration begins, given the tractions of undecided() at its end [MPa] (see
  /// ActiveSet::opening()). `opened`: nodes assumed open in these tractions; they are returned if the matrix may not
  /// change the status of so many nodes.
  NodeFlags opening(const VectorXd& tractions, const NodeFlags& opened) const;
  /// Opens these nodes and closes all others that are nearing. The change of the loads at this state that follows is
  /// the change as the iteration begins.
  void open(const NodeFlags& nodes, const FacingFields& fields);

  /// Adds the residual of the change of the loads at the start of the iteration. Returns false if the loads act at
  /// other points than those before; the sum is then invalid.
  ///
  /// Loads of a correction use the works of the tangent. A large penalty makes a large load of a gap, and works of the
  /// present state would turn this load away from the solution by the matrix.
  bool residual_change(const FacingFields& fields, double dt, const AddVector& add) const;

 private:
  struct Nothing {};
  struct AtPoints {
    NodalLoads loads;
  };
  struct ByWorks {
    NodalLoads loads;
  };
  /// Adds the residual of a change of loads at the points of the iteration.
  void residual_of(const AtPoints& change, const FacingFields& fields, double dt, const AddVector& add) const;
  /// Loads of the true averages.
  NodalLoads true_loads(const FacingFields& fields, ContactStatus status) const;
  /// The error that the tractions of a correction may have: it closes the rest of a gap against the stiffness of the
  /// adjoining elements, however large a load the penalty makes of that.
  double doubt(const NodalLoads& predicted, const NodalLoads& now) const;
  /// Whether this status is another one by nodes that may be released or added, and not by more than `most`.
  bool may_take(const NodeFlags& status, Index most) const;
  /// Nodes that a status has in contact and that have no linearisation.
  NodeFlags unknown_of(const NodeFlags& status) const;
  /// Whether some nodes of a patch have no equations of their own, so that its load is no unknown of the matrix.
  bool is_of_rigid_bodies(const Patch& patch) const;
  /// The status with these nodes open, and all others that are nearing in contact.
  NodeFlags status_without(const NodeFlags& open) const;
  /// Linearises further nodes where the surfaces are now.
  void linearise_more(const NodeFlags& nodes, const FacingFields& fields);
  IndexedVector<int> linearised(bool in_contact, bool is_added) const;
  /// Sets the status that the loads need. Returns whether this has added nodes.
  bool change_status(const NodalLoads& predicted, const NodalLoads& now, const FacingFields& fields);

  const MortarSpace& space_;
  const NodalLaws& laws_;
  ActiveSet& active_set_;
  const EnforcementMethod& method_;
  LinearisationPoint* point_ = nullptr;  ///< the linearisation of the geometry
  /// The change of the loads as the iteration began; std::monostate where it is unknown.
  std::variant<std::monostate, Nothing, AtPoints, ByWorks> change_;
  bool begins_ = false;      ///< whether the iteration of the matrix is the first one
  double last_error_ = 0;    ///< error of the tractions at the last correction; 0 before any of this status
  bool has_matrix_ = false;  ///< whether the host's matrix belongs to this linearisation
  HostMatrix matrix_;        ///< that
  NodeFlags added_;          ///< nodes linearised after the matrix was formed
};

}  // namespace mixture_contact
