/// The active set: the decision which nodes are in contact, stick and slide.
#pragma once

#include "conditions/nodal_laws.h"

#include <optional>

namespace mixture_contact {

/// The constants of the active set, each with its reason.
struct ActiveSetOptions {
  /// Tractions below this fraction of the largest one do not change a status: they are rounding and the remaining error
  /// of Newton's method.
  double negligible_traction = 1e-6;
  /// Surfaces with gaps below this fraction of their size touch within rounding.
  double touch_fraction = 1e-10;
  /// A node whose status changes more often than this within a time step is at the edge of contact: it has closed,
  /// opened and closed again. The limit also holds for nodes of the secondary surface that face contact.
  int most_status_changes = 3;
  /// A node is also at the edge of contact if it has changed this often since the last iteration in which any node
  /// changed for the first time: it opens and closes by itself.
  int most_changes_alone = 2;
  /// Nodes that have changed more often than this within a time step cycle. Only one of them then changes in an
  /// iteration, together with all nodes that do not cycle.
  int most_joint_changes = 2 * most_status_changes;
  /// A node of the secondary surface is in contact if the contact status that is interpolated from the opposite primary
  /// nodes reaches this value: the middle between contact (1) and no contact (0), minus rounding.
  double contact_share = 0.5 - 1e-9;
  /// In a step, a node of the secondary surface changes its status only if its share passes the middle by this margin.
  /// The pressure of a node deforms its surface and moves the point that the node faces: without a margin, a node close
  /// to the middle may have no status that agrees with its position. The size is a choice: a quarter is the weight of
  /// one node in the middle of a quadrilateral.
  double contact_share_margin = 0.25;
  /// Loads that differ by less than this fraction of the largest one count as equal: nodal averages have rounding
  /// errors of this size. A larger difference requires another evaluation of the residual.
  double same_load = 1e-9;
  /// A node keeps its status stick or slip while the trial friction differs from the bound by less than this fraction
  /// of the largest bound. It is the remaining error of Newton's method, as for negligible_traction.
  double friction_band = 1e-6;
  /// The friction band, as friction_band, of a node that has changed between stick and slip more often than
  /// most_status_changes within a time step. Such a node is at the edge of sliding, where both laws agree. The band
  /// equals the error that the loads of a solution may have.
  double edge_friction_band = 1e-2;
  /// Loads of the linearised laws count as those of a solution if they differ from those of the true laws by less than
  /// this fraction of the largest one. The size is a choice without derivation.
  double solution_load = 1e-2;
  /// The next iteration keeps a linearisation if its correction has reduced the error of the loads to less than this
  /// fraction. The size is a choice: corrections that converge leave about a tenth.
  double most_left = 0.5;
  /// The largest number of nodes whose status may differ from that in the matrix in its first iteration. Each node
  /// takes the host one back substitution; together they save an iteration. The size is a choice, slightly above the
  /// fifty nodes of a joint of tetrahedra at its first load.
  Index most_changed = 60;
  /// The largest number of nodes whose status may differ from that in the matrix in an iteration that reuses the
  /// matrix. Reuse saves an assembly and factorisation, which take as long as fifty back substitutions or more. The
  /// size is a choice below that.
  Index most_changed_again = 40;
};

/// Primal-dual active set (Hintermueller, Ito and Kunisch 2002): a node in contact remains in contact while its
/// predicted load is compressive; an open node closes if it overlaps.
///
/// If the laws bear tension, a node remains in contact as long as it faces the other surface.
///
/// With friction, a node in contact sticks until its trial friction exceeds the bound, and slides until the trial falls
/// below the bound. It begins with the status of the last step or, if it was open, with that of its trial. The
/// iteration also decides whether the bound is zero. The formula of T_max is linear in the unknowns and, like t_n, may
/// be negative after an overlap at the start of an iteration with a large penalty; the prediction of the iteration
/// counts.
///
/// A node that closes within the iterations begins in the same way as at the start of iterations. A sticking node in
/// tension slides before it opens, because its friction may cause the tension.
///
/// Rigid bodies whose nodes would all open remain in contact for one iteration of a step. The first iteration moves
/// them along chords, which leaves a gap of second order in the rotation, and a body that only this contact supports
/// has no other stiffness.
///
/// A node whose status keeps changing is at the edge of contact: with coupled fluxes it opens, and at the ambient
/// pressure it closes. Traction and pressure tend to the ambient ones at the edge, and the node is then in contact
/// without coupled fluxes. Iterations far from a solution may change nodes as often; a solution therefore retries its
/// edge nodes once, except those that have cycled alone.
///
/// Nodes may also keep changing together, because they are in tension in contact and overlap when open. Only the first
/// of these nodes then changes in each iteration. Each node changes a limited number of times together with others, and
/// then by the least index rule (Murty 1974, Opsearch 11:123-130). This rule terminates if each load grows with its own
/// gap for any status of the other nodes (a P matrix).
class ActiveSet {
 public:
  explicit ActiveSet(const NodalLaws& laws, ActiveSetOptions options = {}) : options_(options) { start_counting(laws); }

  const ActiveSetOptions& options() const { return options_; }

  /// Permits only these nodes to close.
  void restrict_to(NodeFlags nodes) { restriction_ = std::move(nodes); }
  bool is_restricted() const { return restriction_.has_value(); }

  /// The contact status from the true gaps, before any iteration.
  NodeFlags initial(const NodalLaws& laws, const NodalGaps& now) const;
  /// The contact status from the predicted loads of an iteration and the true gaps. `doubt`: error of the predicted
  /// tractions; smaller tractions do not change a status [MPa].
  NodeFlags updated(const NodalLaws& laws, const NodalLoads& predicted, const NodalGaps& now, double doubt = 0) const;
  /// The nodes in contact at the start of an iteration that open in it. `tractions`: at the end of the iteration if the
  /// nodes stayed in contact [MPa]; NaN for open nodes and unknown tractions, which do not open. `opened`: nodes
  /// assumed open for these tractions. Nodes whose status keeps changing do not open: they are at the edge of contact,
  /// and the next iteration decides.
  NodeFlags opening(const NodalLaws& laws, const VectorXd& tractions, const NodeFlags& opened,
                    double surface_size) const;
  /// The contact status at another state within a step, from the loads of the last state: nodes that face nothing open,
  /// and nodes that overlap close.
  ContactStatus moved(const NodalLaws& laws, const NodalLoads& last, const NodalGaps& now) const;

  /// Resets all counts of changes, at the start of iterations.
  void start_counting(const NodalLaws& laws);
  /// The contact status of the next iteration: `updated`, except for nodes that cycle. `counts`: true if the status
  /// `before` belongs to an iteration, so that changes are counted.
  ContactStatus next(const NodalLaws& laws, const NodeFlags& before, NodeFlags updated, bool counts);

  /// True if a solution has nodes at the edge of contact that have to be tried once more, because other nodes may have
  /// caused their changes. It then resets all counts, such that the next iteration couples their fluxes again.
  ///
  /// A node remains at the edge if it has changed most_changes_alone times since the last iteration in which any node
  /// changed for the first time, or if it was an edge node in the last accepted step. The result is true at most once
  /// after the start of iterations.
  bool reconsiders_edge(const NodalLaws& laws, const NodalLoads& solution);

  /// The friction status according to the predicted loads of an iteration, which have to include friction.
  FrictionStatus updated_friction(const NodalLaws& laws, const NodalLoads& predicted) const;
  /// The friction status in the next iteration with the loads `now`: that of updated_friction(), except for nodes that
  /// cycle. Nodes that close have the status of their own loads. Changes are counted.
  FrictionStatus next_friction(const NodalLaws& laws, const NodalLoads& predicted, const NodalLoads& now);

  /// Memory of the counts [bytes].
  std::size_t memory() const {
    return (changes_.capacity() + repeated_changes_.capacity() + slip_changes_.capacity()) * sizeof(int);
  }

 private:
  bool may_close(Index node) const { return !restriction_ || (*restriction_)[node]; }
  /// FrictionStatus::slips of updated_friction(). `bands`: half-widths of the friction bands of the nodes [MPa].
  NodeFlags updated_slips(const NodalLaws& laws, const NodalLoads& predicted, const VectorXd& bands) const;
  /// True if the slip of a node reverses without sticking first: with the stiffness of the adjoining elements, reversed
  /// friction could not hold the node. It is true once in a step; a node that should stick does so in the next
  /// iteration.
  bool turns_round(const NodalLaws& laws, const NodalLoads& predicted, Index node) const;
  /// True if a node opens and closes by itself (see ActiveSetOptions::most_changes_alone).
  bool cycles_alone(Index node) const;
  /// Counts the changes of status in an iteration.
  void count(const NodalLaws& laws, const NodeFlags& before, const NodeFlags& status);
  /// True if all nodes in contact between rigid bodies would open, for the first time in a step.
  bool waits(const NodalLaws& laws, const NodeFlags& before, const NodeFlags& updated);
  /// True if an open node comes into contact.
  bool closes(const NodalLaws& laws, const NodalGaps& now, Index node, double negligible) const;

  ActiveSetOptions options_;
  std::optional<NodeFlags> restriction_;  ///< nodes that may close; empty: all
  bool has_waited_ = false;               ///< true if waits() has been true since the start of iterations
  bool has_reconsidered_ = false;         ///< true if reconsiders_edge() has been true since the start of iterations
  IndexedVector<int> changes_;            ///< number of changes of each node's status since the start of iterations
  /// Number of changes since the last iteration in which any node changed for the first time.
  IndexedVector<int> repeated_changes_;
  /// Number of changes between stick and slip since the start of iterations; empty without friction.
  IndexedVector<int> slip_changes_;
};

/// True if the status of nodes may be predicted by solutions with the matrix. It is false with exchanged fields: their
/// exchange may open a node that would close, or close one that would open, and both may be equilibria. It is false
/// with self-contact, because a fold may face other facets at the end of an iteration, and with tension, because nodes
/// that bear tension do not open.
bool may_predict(const NodalLaws& laws);

/// Slip and positive friction bounds at the start of iterations.
FrictionStatus initial_friction(const NodalLaws& laws, const NodalLoads& now);
/// The friction status at another state within a step. Nodes in contact in both keep the status of the loads `last`.
FrictionStatus moved_friction(const NodalLaws& laws, const NodalLoads& last, const NodalLoads& now);

}  // namespace mixture_contact
