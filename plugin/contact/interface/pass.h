/// One pass of a contact: the integral (2.5) over one surface against the other.
#pragma once

#include "enforcement/contact_geometry.h"
#include "enforcement/unknown_multipliers.h"

namespace mixture_contact {

/// The integral over one surface. It owns the integration points, laws, active set, enforcement method and geometry.
/// Projections change the pairs of facets, the iterations of the geometry change the linearisation, and augment()
/// changes the multipliers.
class ContactPass {
 public:
  /// Keeps references to both meshes, the effects and the settings.
  ContactPass(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects,
              const Settings& settings);

  /// Projects each integration point onto the nearest facet of the secondary surface that faces it within reach.
  void project(const FacingPositions& x, const Reach& reach);

  /// Projects points without a search, onto the facets that the last project() found for them.
  void project_on_same_facets(const FacingPositions& x);

  /// Restricts the active set to these nodes, and the pass to their facets: no other nodes may close. It takes effect
  /// with the next project().
  void restrict_active_set(const NodeFlags& nodes);

  /// The evaluation of the integral, and its iterations.
  ContactGeometry& geometry() const { return *geometry_; }

  /// Uzawa's update: the loads of an equilibrium become the multipliers, lambda <- t_n, w_n, j_n. Multipliers of nodes
  /// out of contact become zero; multipliers of tractions that are not exchanged stay the same. The next iteration uses
  /// the multipliers for the geometric part of the tangent, because lambda + eps g is up to twice the load in
  /// equilibrium until the gaps close.
  void augment(const FacingFields& fields);

  /// Sets the gap at which the surfaces touch [mm], from which gaps are measured.
  void measure_gaps_from(double offset) { parts_.space.measure_gaps_from(offset); }

  /// The averages of slips with the start of the step.
  SlipAverages& slips() const { return parts_.space.kept_slips(); }

  /// Accepts a state as the start of the next step: its loads, flux-coupled nodes, and positions as the reference of
  /// slips. Returns true if this changes averages, so that the iterations have to end.
  bool accept_step(const FacingFields& fields);

  /// Sets earlier decisions on the nodes that bear load (see BoundaryWeights), for a restart.
  void restore_carriers(LoadCarriers decisions) { parts_.space.boundary_weights().restore(std::move(decisions)); }

  /// Discards the configuration. To be called after a change of the effects, before the next project().
  void forget();

  /// The loads of the laws at the nodes.
  NodalLoads nodal_loads(const FacingFields& fields) const { return geometry_->loads(fields); }

  /// True if the tangents of nodes can be passed on as load blocks.
  bool has_load_blocks() const { return parts_.has_load_blocks(); }

  /// Primary nodes that are in contact and flux-coupled.
  NodeFlags flux_coupled() const { return geometry_->flux_coupled(); }

  const MortarSpace& space() const { return parts_.space; }
  /// The pairs of facets that face each other.
  const IndexedVector<FacetPair>& pairs() const { return parts_.space.facing().pairs(); }
  const ActiveSet& active_set() const { return parts_.active_set; }
  NodalLaws& laws() { return parts_.laws; }
  const NodalLaws& laws() const { return parts_.laws; }
  const Penalties& penalty() const { return parts_.laws.penalties(); }
  /// Memory kept between calls [bytes]: pairs with their points, multipliers, penalties, and data of iterations.
  std::size_t memory() const;

 private:
  std::unique_ptr<ContactGeometry> make_geometry();

  PassParts parts_;
  std::unique_ptr<ContactGeometry> geometry_;
};

}  // namespace mixture_contact
