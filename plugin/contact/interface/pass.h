/// One pass of a contact: the integral (2.5) over one surface against the other.
#pragma once

#include "active_set/active_set.h"
#include "enforcement/contact_geometry.h"
#include "enforcement/unknown_multipliers.h"

namespace mixture_contact {

/// The integral over one surface. It owns the integration points, laws, active set, enforcement method and geometry.
/// Evaluations are const. Projections change the pairs of facets; begin_iteration() and similar functions change the
/// linearisation; augment() changes the multipliers.
class ContactPass {
 public:
  /// Keeps references to both meshes, the effects and the settings.
  ContactPass(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects,
              const Settings& settings);

  /// Projects each integration point onto the nearest facet of the secondary surface that faces it within reach.
  void project(const FacingPositions& x, const Reach& reach);

  /// Projects points without a search, onto the facets that the last project() found for them.
  void project_on_same_facets(const FacingPositions& x);

  /// Begins a Newton iteration at a state: decides which nodes are in contact (see ActiveSet), and linearises their
  /// gaps and jumps. Both are kept until the next call: in the iteration and its line search, loads are linear in the
  /// unknowns and no status changes.
  ///
  /// Returns true if the loads at this state differ from those before the call.
  bool begin_iteration(const FacingFields& fields) { return geometry_->begin_iteration(fields); }

  /// Begins at a state without a tangent, as in explicit dynamics: decides which nodes are in contact by the true laws,
  /// and keeps the loads of this state for residuals.
  void hold_loads(const FacingFields& fields) { geometry_->hold_loads(fields); }

  /// Restricts the active set to these nodes, and the pass to their facets: no other nodes may close. It takes effect
  /// with the next project().
  void restrict_active_set(const NodeFlags& nodes);

  /// The evaluation of the integral. It is used by hosts that keep their matrix (corrections.h), and for
  /// start_inactive(), which begins an iteration with all nodes open when a second pass is added within a step.
  ContactGeometry& geometry() const { return *geometry_; }

  /// Moves the linearisation point of an iteration to another state, for which project() has been called. Gaps and
  /// jumps are measured and linearised there; status and predicted loads stay the same. Nodes that face nothing in the
  /// new state open, and nodes that overlap in it close.
  void linearise_at(const FacingFields& fields) { geometry_->relinearise(fields); }

  /// Uzawa's update: the loads of an equilibrium become the multipliers, lambda <- t_n, w_n, j_n. Multipliers of nodes
  /// out of contact become zero; multipliers of tractions that are not exchanged stay the same. The next
  /// begin_iteration() uses the multipliers for the geometric part of the tangent, because lambda + eps g is up to
  /// twice the load in equilibrium until the gaps close.
  void augment(const FacingFields& fields);

  /// Sets the gap at which the surfaces touch [mm], from which gaps are measured.
  void measure_gaps_from(double offset) { space_.measure_gaps_from(offset); }

  /// Sets the positions from which slips are measured.
  void measure_slips_from(const FacingPositions& past) { space_.measure_slips_from(past); }

  /// Accepts a state as the start of the next step: its loads, flux-coupled nodes, and positions as the reference of
  /// slips.
  void accept_step(const FacingFields& fields);

  /// Ends the iterations: removes the linearisation, such that the laws apply to the true gaps and jumps.
  void end_iterations() { geometry_->end_iterations(); }

  /// Sets earlier decisions on the nodes that bear load (see BoundaryWeights), for a restart.
  void restore_carriers(LoadCarriers decisions) { space_.boundary_weights().restore(std::move(decisions)); }

  /// Discards the configuration. To be called after a change of the effects, before the next project().
  void forget();

  /// True if the linearised loads of a state agree with those of the true laws within a fraction. A state found with
  /// constant status and linearised gaps is a solution only then.
  bool is_solution(const FacingFields& fields) const { return geometry_->is_solution(fields); }

  /// The loads of the laws at the nodes.
  NodalLoads nodal_loads(const FacingFields& fields) const { return geometry_->loads(fields); }

  /// Calls `add` with the residual of (2.5), one part per pair of facets that carries load.
  void residual(const FacingFields& fields, double dt, const AddVector& add) const;

  /// Calls `add` with the tangent (2.6), effect by effect. The geometric part comes per pair of facets that carries
  /// load, or summed at nodes. The part of the laws comes per node in contact, and couples all nodes of its averages.
  void tangent(const FacingFields& fields, double dt, const TangentParts& add) const;

  /// Calls `use` with the patches of tangent(), for a matrix profile.
  void for_each_coupling(const Couplings& use) const { geometry_->for_each_coupling(use); }

  /// True if the tangents of nodes can be passed on as load blocks.
  bool has_load_blocks() const { return method_->has_load_blocks(); }

  /// Primary nodes that are in contact and flux-coupled.
  NodeFlags flux_coupled() const { return geometry_->flux_coupled(); }

  const MortarSpace& space() const { return space_; }
  /// The pairs of facets that face each other.
  const IndexedVector<FacetPair>& pairs() const { return space_.facing().pairs(); }
  const ActiveSet& active_set() const { return active_set_; }
  NodalLaws& laws() { return laws_; }
  const NodalLaws& laws() const { return laws_; }
  const Penalties& penalty() const { return laws_.penalties(); }
  /// Memory kept between calls [bytes]: pairs with their points, multipliers, penalties, and data of iterations.
  std::size_t memory() const;

 private:
  std::unique_ptr<ContactGeometry> make_geometry();

  const Effects& effects_;
  MortarSpace space_;
  NodalLaws laws_;
  ActiveSet active_set_;
  std::unique_ptr<EnforcementMethod> method_;
  std::unique_ptr<ContactGeometry> geometry_;
};

}  // namespace mixture_contact
