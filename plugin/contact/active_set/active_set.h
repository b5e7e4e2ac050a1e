/// The active set: which nodes are in contact. It decides status and nothing else.
#pragma once

#include "conditions/nodal_laws.h"

#include <optional>

namespace mixture_contact {

/// All constants of the active set, each with its reason.
struct ActiveSetOptions {
  /// Tractions below this part of the largest one do not decide: rounding, and what Newton leaves.
  double negligible_traction = 1e-6;
  /// Surfaces closer than this part of their size touch to rounding.
  double touch_fraction = 1e-10;
  /// A node whose status changes more often within a time step is at the edge of contact: it came, went and came again.
  /// Nodes that face contact are so, too.
  int most_status_changes = 3;
  /// Nodes that have changed more often than this within a time step cycle: from then on these change one at a time,
  /// and all others together.
  int most_joint_changes = 2 * most_status_changes;
  /// A node of the surface that faces the one integrated over is in contact where the contact of the nodes that it
  /// faces, interpolated, reaches this share: a half, halfway between a node in contact and one that is not, less
  /// rounding.
  double contact_share = 0.5 - 1e-9;
  /// Loads that differ by less than this part of the largest one are the same: rounding, as the averages around nodes
  /// sum it up. A larger difference has the residual evaluated again.
  double same_load = 1e-9;
  /// A node keeps to stick or slip while the trial friction comes this near to the bound, as a part of the largest
  /// one: what Newton leaves, as negligible_traction.
  double friction_band = 1e-6;
  /// The friction band of a node that has changed between stick and slip more often than most_status_changes within a
  /// time step: it is at the edge of sliding, where both laws say the same. As near as loads have to come to be those
  /// of a solution.
  double edge_friction_band = 1e-2;
  /// Loads of the linearised laws are those of a solution where they come this near to those of the true ones, as a
  /// part of the largest one. The size is a choice: no derivation stands behind it.
  double solution_load = 1e-2;
  /// A linearisation that is held serves another iteration where its correction has left less than this part of the
  /// error of the loads. The size is a choice: corrections that end leave a tenth each.
  double most_left = 0.5;
  /// Nodes at most whose status may be another one than in the linearisation that a matrix is of, as its first
  /// iteration begins: each costs the host a back substitution, for an iteration less. The size is a choice, above the
  /// fifty that a joint of tetrahedra asks for as it is pressed together.
  Index most_changed = 60;
  /// The counterpart of most_changed for an iteration that goes on with the matrix: for another matrix less, which
  /// costs fifty of them or more. The size is a choice below that.
  Index most_changed_again = 40;
};

/// Primal-dual active set (Hintermueller, Ito and Kunisch 2002): a node in contact stays so while its load, as the last
/// iteration predicts it, is compressive; a node out of contact enters where it overlaps.
///
/// A node in contact stays so as long as it faces the other surface, if the laws bear tension.
///
/// A node in contact with friction sticks until its trial friction exceeds the bound, and slides until it falls below.
/// It begins to stick or slide as it ended the step before; where it was not in contact, as its own trial says. The
/// bound holds on to being zero or not, too: where t_n is linear in the unknowns, so is T_max, also below zero, which
/// the overlap that is measured at the start of an iteration can make of it and a large penalty. The prediction of the
/// iteration decides.
///
/// A node that closes within iterations begins as one does where iterations begin. A node that sticks and is pulled
/// slides before it opens: what pulls it may be what holds it.
///
/// Rigid bodies that would part at once do not in the first iteration of a step that says so: they move along chords
/// there, which leaves a gap of second order in the rotation, and a body that this contact alone holds has no stiffness
/// without it.
///
/// A node whose status keeps changing is at the edge of contact: flux-coupled it opens, at the ambient pressure it
/// closes. There traction and pressure both tend to those of the ambient, so it is in contact but not flux-coupled from
/// then on. Iterations far from a solution may change nodes as often: at a solution those at the edge are tried once
/// more, unless they have cycled alone. Nodes may keep changing together, closed pulled and open overlapping: the first
/// alone of those that cycle then changes in each iteration. Each node changes a bounded number of times with others;
/// from then on the rule is the least index rule (Murty 1974, Opsearch 11:123-130), which ends where each load grows
/// with its own gap however the others are held: a P matrix.
class ActiveSet {
 public:
  /// Keeps a reference to the laws.
  explicit ActiveSet(const NodalLaws& laws, ActiveSetOptions options = {}) : laws_(laws), options_(options) {}

  const ActiveSetOptions& options() const { return options_; }

  /// Lets only some nodes close.
  void restrict_to(NodeFlags nodes) { restriction_ = std::move(nodes); }
  bool is_restricted() const { return restriction_.has_value(); }

  /// Status where no iteration has begun: what the true gaps say.
  NodeFlags initial(const NodalGaps& now) const;
  /// Whether solutions with the matrix may predict the status of nodes. Fields rule it out: exchange may push a node
  /// open that would close, or the other way round, and either may be an equilibrium. Self-contact rules it out:
  /// a fold has other facets to face at the end of an iteration. And nodes that may pull do not open.
  bool may_predict() const;
  /// Status that the loads which an iteration predicts ask for, given the true gaps. `doubt`: what predicted tractions
  /// may be off by, so that none below it decides.
  NodeFlags updated(const NodalLoads& predicted, const NodalGaps& now, double doubt = 0) const;
  /// Nodes that began an iteration in contact and open within it, given what their tractions come to should they stay
  /// [MPa]; NaN where that is unknown, and for nodes out of contact: these do not. `opened`: those that were taken to
  /// be open in finding them. Nodes whose status keeps changing stay out: they are at the edge of contact, and the next
  /// iteration decides.
  NodeFlags opening(const VectorXd& tractions, const NodeFlags& opened, double surface_size) const;
  /// Status at another state within a step, to which loads of the last one hold on: nodes that face nothing open, and
  /// those that overlap close.
  ContactStatus moved(const NodalLoads& last, const NodalGaps& now) const;

  /// Forgets how often nodes have changed.
  void start_counting();
  /// The status of the next iteration: the updated one, but where changes lead in cycles. Counts changes where the
  /// status before was that of an iteration, too.
  ContactStatus next(const NodeFlags& before, NodeFlags updated, bool counts);

  /// Whether a solution has nodes at the edge of contact that have to be tried once more: they were put there for how
  /// often they had changed while other nodes changed for the first time. All changes are forgotten, so that the next
  /// iteration has them flux-coupled. Nodes stay out that changed most_status_changes times after the last first change
  /// of any node, or that were at the edge in the last accepted step. Once at most from where iterations begin.
  bool reconsiders_edge(const NodalLoads& solution);

  /// Nodes in contact that slide where iterations begin.
  NodeFlags initial_slip(const NodalLoads& now) const;
  /// Nodes that slide as the loads that an iteration predicts ask for; loads with friction.
  NodeFlags updated_slip(const NodalLoads& predicted) const;
  /// Nodes that slide in the next iteration, at the loads `now`: those of updated_slip(), but where changes lead in
  /// cycles; nodes that come into contact there as their own trial says. Counts changes.
  NodeFlags next_slip(const NodalLoads& predicted, const NodalLoads& now);
  /// The slip of loads of the last iteration that stays at another state within a step.
  NodeFlags moved_slip(const NodalLoads& last, const NodalLoads& now) const;

  /// Nodes in contact with a positive friction bound where iterations begin.
  NodeFlags initial_rubs(const NodalLoads& now) const;
  /// Nodes with a positive friction bound by the loads that an iteration predicts.
  NodeFlags updated_rubs(const NodalLoads& predicted) const;
  /// Nodes with a positive friction bound in the next iteration, at the loads `now`: those of updated_rubs(); nodes
  /// that come into contact there as their own loads have it.
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
  /// How near to the bound trials do not decide, for nodes at the edge of sliding and for others.
  struct FrictionBands {
    double elsewhere;
    double at_edge;
  };
  FrictionBands friction_bands(const NodalLoads& predicted) const;
  double friction_band(const FrictionBands& bands, Index node) const;
  /// Whether it is to do so without sticking first: it slides back by more than turning its friction round can hold, by
  /// the stiffness of the adjoining elements. Once in a step: where it should stick, the next iteration has it stick.
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
