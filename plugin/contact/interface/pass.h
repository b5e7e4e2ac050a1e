/// One pass of a contact: the integral (2.5) over one surface against the other.
#pragma once

#include "active_set/active_set.h"
#include "enforcement/contact_geometry.h"
#include "enforcement/unknown_multipliers.h"

namespace mixture_contact {

/// The integral over one surface: owner of its points, laws, active set, enforcement and geometry. Evaluations are
/// const; projections replace the pairs of facets, begin_iteration() and its relatives the linearisation, and augment()
/// the multipliers.
class ContactPass {
 public:
  /// Keeps references.
  ContactPass(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects,
              const Settings& settings);

  /// Projects every integration point onto the secondary surface: of the facets that face it within reach, the
  /// nearest.
  void project(const FacingPositions& x, const Reach& reach);

  /// Projects points without a search: they keep to the facets that the last project() found for them.
  void project_on_same_facets(const FacingPositions& x);

  /// Begins a Newton iteration at a state: decides which nodes are in contact (see ActiveSet), and holds that and the
  /// linearisation of their gaps and jumps until the next call. Loads are then linear in the unknowns in the iteration
  /// and its line search, and no status changes.
  ///
  /// Returns whether the loads at this state differ from those before the call.
  bool begin_iteration(const FacingFields& fields) { return geometry_->begin_iteration(fields); }

  /// Begins at a state where no tangent follows, as in explicit dynamics: decides which nodes are in contact by the
  /// true laws, and holds the loads of this state, without their linearisation, for residuals at it.
  void hold_loads(const FacingFields& fields) { geometry_->hold_loads(fields); }

  /// Restricts the active set to these nodes and all of their facets: no others may close. Takes effect with the next
  /// project().
  void restrict_active_set(const NodeFlags& nodes);

  /// The evaluation of the integral: for hosts that keep their matrix (corrections.h), and start_inactive(),
  /// which begins an iteration with every node open, for a pass that joins others within a step.
  ContactGeometry& geometry() const { return *geometry_; }

  /// Moves the linearisation point of an iteration to another state, at which project() has been called: gaps and jumps
  /// are measured and linearised there, while status and predicted loads remain. Nodes that face nothing there open,
  /// and those that overlap there close.
  void linearise_at(const FacingFields& fields) { geometry_->relinearise(fields); }

  /// Uzawa's update: the loads of an equilibrium become the multipliers, lambda <- t_n, w_n, j_n; nodes out of contact
  /// get zero, and multipliers of tractions that are not exchanged stay. The next begin_iteration() takes them for the
  /// geometric part of the tangent, because the load by the laws, lambda + eps g, is up to twice that in equilibrium
  /// until the gaps close.
  void augment(const FacingFields& fields);

  /// Sets the distance of the surfaces from which gaps are measured [mm].
  void measure_gaps_from(double offset) { space_.measure_gaps_from(offset); }

  /// Sets the reference positions of slips.
  void measure_slips_from(const FacingPositions& past) { space_.measure_slips_from(past); }

  /// Accepts a state as the start of the next step: its loads, flux-coupled nodes, and positions as the reference of
  /// slips.
  void accept_step(const FacingFields& fields);

  /// Drops the linearisation of begin_iteration(): the laws act on the true gaps and jumps again.
  void end_iterations() { geometry_->end_iterations(); }

  /// Continues from earlier decisions on the nodes that bear load (see BoundaryWeights).
  void restore_carriers(LoadCarriers decisions) { space_.boundary_weights().restore(std::move(decisions)); }

  /// Drops the configuration. Call this after a change of the effects, before the next project().
  void forget();

  /// Whether a state is a solution of the true laws to a fraction of the loads: a state found with held status and gaps
  /// counts only then.
  bool is_solution(const FacingFields& fields) const { return geometry_->is_solution(fields); }

  /// The loads by the laws at the nodes.
  NodalLoads nodal_loads(const FacingFields& fields) const { return geometry_->loads(fields); }

  /// Residual of (2.5), in one part per pair of facets that carries load.
  void residual(const FacingFields& fields, double dt, const AddVector& add) const;

  /// Tangent (2.6), effect by effect: the geometric part per pair of facets that carries load, or summed at nodes, and
  /// per node in contact the part of its laws, which couples all nodes that its averages are taken over.
  void tangent(const FacingFields& fields, double dt, const TangentParts& add) const;

  /// The patches that tangent() would fill, for a matrix profile.
  void for_each_coupling(const Couplings& use) const { geometry_->for_each_coupling(use); }

  /// Whether the tangents of nodes come as load blocks to those who take them.
  bool has_load_blocks() const { return method_->has_load_blocks(); }

  /// Primary nodes that are in contact and flux-coupled by it.
  NodeFlags flux_coupled() const { return geometry_->flux_coupled(); }

  const MortarSpace& space() const { return space_; }
  /// The pairs of facets that face each other, with their integration points.
  const IndexedVector<FacetPair>& pairs() const { return space_.facing().pairs(); }
  const ActiveSet& active_set() const { return active_set_; }
  NodalLaws& laws() { return laws_; }
  const NodalLaws& laws() const { return laws_; }
  const Penalties& penalty() const { return laws_.penalties(); }
  /// Bytes that are kept between calls: pairs with their points, multipliers, penalties, and the data of iterations.
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
