/// The active set: which nodes are in contact. It decides status and nothing else.
#pragma once

#include "conditions/nodal_laws.h"

#include <optional>

namespace mixture_contact {

/// All constants of the active set, each with its reason.
struct ActiveSetOptions {
  /// Tractions below this part of the largest one do not decide: they are rounding and the remainder of Newton's
  /// method.
  double negligible_traction = 1e-6;
  /// Surfaces closer than this part of their size touch to rounding.
  double touch_fraction = 1e-10;
  /// A node whose status changes more often within a time step is at the edge of contact: it has closed, opened and
  /// closed again. The limit also holds for nodes that face contact.
  int most_status_changes = 3;
  /// Nodes that have changed more often than this within a time step cycle: from then on these change one at a time,
  /// and all others together.
  int most_joint_changes = 2 * most_status_changes;
  /// A node of the other surface is in contact if the interpolated contact of its opposite nodes reaches this share: a
  /// half, the middle between contact and no contact, less rounding.
  double contact_share = 0.5 - 1e-9;
  /// Loads that differ by less than this part of the largest one are equal: averages around nodes sum up rounding of
  /// this size. A larger difference requires another evaluation of the residual.
  double same_load = 1e-9;
  /// A node keeps stick or slip while the trial friction is this near to the bound, as a part of the largest one: the
  /// remainder of Newton's method, as negligible_traction.
  double friction_band = 1e-6;
  /// The friction band of a node that has changed between stick and slip more often than most_status_changes within a
  /// time step: it is at the edge of sliding, where both laws agree. The band equals the error that a solution may have
  /// in its loads.
  double edge_friction_band = 1e-2;
  /// Loads of the linearised laws are those of a solution if they differ from those of the true laws by less than this
  /// part of the largest one. The size is a choice without derivation.
  double solution_load = 1e-2;
  /// The next iteration keeps a linearisation if its correction has left less than this part of the error of the loads.
  /// The size is a choice: corrections that converge leave a tenth each.
  double most_left = 0.5;
  /// The largest number of nodes that may change their status against the linearisation of a matrix in its first
  /// iteration: each takes the host a back substitution, and together they save an iteration. The size is a choice
  /// above the fifty nodes of a joint of tetrahedra at its first load.
  Index most_changed = 60;
  /// The counterpart of most_changed for an iteration that keeps the matrix: it saves a matrix, which takes as long as
  /// fifty back substitutions or more. The size is a choice below that.
  Index most_changed_again = 40;
};

/// Primal-dual active set (Hintermueller, Ito and Kunisch 2002): a node in contact stays in contact while its predicted
/// load is compressive; an open node closes if it overlaps.
///
/// If the laws bear tension, a node stays in contact as long as it faces the other surface.
///
/// A node in contact with friction sticks until its trial friction exceeds the bound, and slides until it falls below.
/// It begins with the status of the last step, or, if it was open, with that of its trial. The iteration also holds
/// whether the bound is zero: T_max is linear in the unknowns as t_n is, also below zero, which an overlap at the start
/// of an iteration and a large penalty can cause. The prediction of the iteration decides.
///
/// A node that closes within iterations begins as a node at the start of iterations. A sticking node that is pulled
/// slides before it opens, because its friction may cause the pull.
///
/// Rigid bodies whose nodes would all open stay in contact for one iteration of a step. The first iteration moves them
/// along chords, which leaves a gap of second order in the rotation, and a body that this contact alone holds has no
/// other stiffness.
///
/// A node whose status keeps changing is at the edge of contact: it opens with coupled fluxes and closes at the ambient
/// pressure. Traction and pressure tend to the ambient ones there, and the node is then in contact without coupled
/// fluxes. Iterations far from a solution may change nodes as often; a solution therefore retries its edge nodes once,
/// except those that have cycled alone. Nodes may also keep changing together: they pull in contact and overlap when
/// open. Only the first of such nodes then changes in each iteration. Each node changes a bounded number of times with
/// others, and then by the least index rule (Murty 1974, Opsearch 11:123-130). This rule terminates if each load grows
/// with its own gap for any status of the others: a P matrix.
class ActiveSet {
 public:
  /// Keeps a reference to the laws.
  explicit ActiveSet(const NodalLaws& laws, ActiveSetOptions options = {}) : laws_(laws), options_(options) {}

  const ActiveSetOptions& options() const { return options_; }

  /// Lets only some nodes close.
  void restrict_to(NodeFlags nodes) { restriction_ = std::move(nodes); }
  bool is_restricted() const { return restriction_.has_value(); }

  /// Status by the true gaps, before any iteration.
  NodeFlags initial(const NodalGaps& now) const;
  /// Whether solutions with the matrix may predict the status of nodes. Fields rule it out: their exchange may open a
  /// node that would close, or close one that would open, and both may be equilibria. Self-contact rules it out: a fold
  /// may face other facets at the end of an iteration. Tension rules it out: nodes that may pull do not open.
  bool may_predict() const;
  /// Status by the predicted loads of an iteration and the true gaps. `doubt`: the error of predicted tractions; none
  /// below it decides.
  NodeFlags updated(const NodalLoads& predicted, const NodalGaps& now, double doubt = 0) const;
  /// Nodes that begin an iteration in contact and open within it, given their tractions at its end if they stayed in
  /// contact [MPa]. Open nodes and unknown tractions have NaN and do not open. `opened`: nodes assumed open in these
  /// tractions. Nodes whose status keeps changing do not open: they are at the edge of contact, and the next iteration
  /// decides.
  NodeFlags opening(const VectorXd& tractions, const NodeFlags& opened, double surface_size) const;
  /// Status at another state within a step, from loads of the last state: nodes that face nothing open, and those that
  /// overlap close.
  ContactStatus moved(const NodalLoads& last, const NodalGaps& now) const;

  /// Resets the counts of changes.
  void start_counting();
  /// The status of the next iteration: the updated one, except for cycles. Counts changes if the status before also
  /// belongs to an iteration.
  ContactStatus next(const NodeFlags& before, NodeFlags updated, bool counts);

  /// Whether a solution has nodes at the edge of contact that have to be tried once more: their many changes may come
  /// from other nodes. Resets all counts, so that the next iteration couples their fluxes again. A node remains at the
  /// edge if it changed most_status_changes times after the last first change of any node, or was an edge node in the
  /// last accepted step. Happens at most once after the start of iterations.
  bool reconsiders_edge(const NodalLoads& solution);

  /// Nodes in contact that slide at the start of iterations.
  NodeFlags initial_slip(const NodalLoads& now) const;
  /// Nodes that slide by the predicted loads of an iteration; loads with friction.
  NodeFlags updated_slip(const NodalLoads& predicted) const;
  /// Nodes that slide in the next iteration, at the loads `now`: those of updated_slip(), except for cycles; nodes that
  /// close slide by their own trial. Counts changes.
  NodeFlags next_slip(const NodalLoads& predicted, const NodalLoads& now);
  /// The slip of loads of the last iteration that stays at another state within a step.
  NodeFlags moved_slip(const NodalLoads& last, const NodalLoads& now) const;

  /// Nodes in contact with a positive friction bound at the start of iterations.
  NodeFlags initial_rubs(const NodalLoads& now) const;
  /// Nodes with a positive friction bound by the loads that an iteration predicts.
  NodeFlags updated_rubs(const NodalLoads& predicted) const;
  /// Nodes with a positive friction bound in the next iteration, at the loads `now`: those of updated_rubs(); nodes
  /// that close have it by their own loads.
  NodeFlags next_rubs(const NodalLoads& predicted, const NodalLoads& now) const;
  /// The positive bound of loads of the last iteration that stays at another state within a step.
  NodeFlags moved_rubs(const NodalLoads& last, const NodalLoads& now) const;

  std::size_t memory() const {
    return (changes_.capacity() + repeated_changes_.capacity() + slip_changes_.capacity()) * sizeof(int);
  }

 private:
  bool may_close(Index node) const { return !restriction_ || (*restriction_)[node]; }
  /// The traction that counts.
  double negligible(double largest_traction, double surface_size) const;
  /// The band around the bound in which trials do not decide, for nodes at the edge of sliding and for others.
  struct FrictionBands {
    double elsewhere;
    double at_edge;
  };
  FrictionBands friction_bands(const NodalLoads& predicted) const;
  double friction_band(const FrictionBands& bands, Index node) const;
  /// Whether a node reverses its slip without sticking first: by the stiffness of the adjoining elements, reversed
  /// friction cannot hold it. Happens once in a step; if the node should stick, it sticks in the next iteration.
  bool turns_round(const NodalLoads& predicted, Index node) const;
  /// Whether a node was in contact and not flux-coupled in the last accepted step.
  bool was_at_edge(Index node) const;
  /// Counts the changes of an iteration.
  void count(const NodeFlags& before, const NodeFlags& status);
  /// Whether all nodes in contact between rigid bodies would open, for the first time in a step.
  bool waits(const NodeFlags& before, const NodeFlags& updated);
  /// Whether a node that is not in contact comes into it.
  bool closes(const NodalGaps& now, Index node, double negligible) const;

  const NodalLaws& laws_;
  ActiveSetOptions options_;
  std::optional<NodeFlags> restriction_;  ///< nodes that may close; none: all
  bool has_waited_ = false;               ///< since the iterations began
  bool has_reconsidered_ = false;         ///< since the iterations began
  IndexedVector<int> changes_;            ///< of each node's status since the iterations began
  IndexedVector<int> repeated_changes_;   ///< those after the last iteration with a first change of any node
  IndexedVector<int> slip_changes_;       ///< the same between stick and slip; empty without friction
};

}  // namespace mixture_contact
