/// The contact laws at the nodes of a surface: penalties, multipliers, and loads from gaps and jumps.
#pragma once

#include "conditions/membrane.h"
#include "conditions/nodal_loads.h"
#include "conditions/normal.h"
#include "conditions/penalty.h"
#include "conditions/tangential.h"

#include <utility>
#include <vector>

namespace mixture_contact {

/// Multipliers at the nodes of the primary surface. Augmentations change them; if the multipliers are unknowns, the
/// host sets them for every trial state.
struct Multipliers {
  VectorXd traction;                  ///< multipliers lambda_n of the normal traction per node [MPa]
  MatrixXd flux;                      ///< multipliers lambda of the fluxes per (field, node)
  double traction_penalty_scale = 1;  ///< factor by which augmentations have increased the traction penalty eps_n
  VectorXd flux_penalty_scale;        ///< factors by which augmentations have increased the flux penalties, per field
  VectorXd accepted_traction;         ///< normal traction t_a of the last accepted step [MPa]; 0 before the first
  /// Nodes that were flux-coupled in the last accepted step; empty if the contact exchanges no fluxes.
  NodeFlags flux_coupled;
  /// Friction multipliers lambda_T per node in the configuration at the start of the step [MPa]; empty without
  /// friction.
  Matrix3Xd friction;
  NodeFlags slips;                    ///< nodes that slide under the multipliers in `friction`
  double friction_penalty_scale = 1;  ///< factor by which augmentations have increased the tangential penalty
};

/// Both indices of nodes that a surface had before a change of its nodes and still has: the new one and the old one.
using CommonNodes = std::vector<std::pair<Index, Index>>;
/// Takes the values of these nodes and the penalty scales from `before`; nothing if the exchanged fields differ.
void carry_over(Multipliers& now, const Multipliers& before, const CommonNodes& nodes);

/// True if multipliers have the nodes and fields of a contact.
bool fits(const Multipliers& multipliers, Index nodes, const Effects& effects);

/// Rounding error of average gaps and jumps, relative to the size of the surface or the field.
inline constexpr double rounding_fraction = 1e-13;

/// A step may begin with tractions that differ from the last accepted ones by this fraction of the largest traction. It
/// is twice the change that an accepted solution may have (see ActiveSetOptions::solution_load).
inline constexpr double accepted_margin = 2e-2;

/// The contact laws at the nodes of a primary surface, with their penalties and multipliers.
class NodalLaws {
 public:
  /// Keeps references to both meshes, the effects and the settings.
  NodalLaws(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects, const Settings& settings);

  /// Discards the results of accepted steps: tractions, friction, slip status, and flux-coupled nodes.
  void forget_steps();
  /// Computes the penalties again after the properties of the surfaces, or the settings, have changed.
  void update_penalties();

  const Effects& effects() const { return effects_; }
  Index nodes() const { return primary_.nodes; }
  /// The penalties at the nodes, without the factors of augmentations.
  const Penalties& penalties() const { return penalties_; }
  /// True if no solution can change the gap of a node, and it therefore has a soft penalty and no augmentation
  /// (PenaltyRule::softens_fixed_gaps).
  bool has_soft_gap(Index node) const { return soft_.count() > 0 && soft_[node]; }
  /// The penalty eps_n of a node [N/mm^3], with the factor of augmentations.
  double traction_penalty(Index node) const {
    return (has_soft_gap(node) ? 1.0 : multipliers.traction_penalty_scale) * penalties_.traction[node];
  }
  /// The flux penalty of a field at a node, with the factor of augmentations.
  double flux_penalty(Index field, Index node) const {
    return multipliers.flux_penalty_scale[field] * penalties_.flux(field, node);
  }

  /// The condition of a field.
  const ScalarCondition& scalar(Index field) const { return *scalars_[field]; }
  /// The multiplier and the penalty of a field at a node.
  Enforcing enforcing(Index field, Index node) const {
    return {multipliers.flux(field, node), flux_penalty(field, node)};
  }

  /// The tangential penalty eps_T of a node [N/mm^3], with the factor of augmentations.
  double friction_penalty(Index node) const {
    const double scale = has_soft_gap(node) ? 1.0 : multipliers.friction_penalty_scale;
    return scale * friction_factor() * penalties_.traction[node];
  }
  /// The tangential penalty divided by the traction penalty [-].
  double friction_factor() const { return settings_.friction.penalty_factor; }

  // Upper limit of augmented traction penalties, as a factor on the stiffness.
  double largest_traction_factor() const {
    return normal().penalty_factor(has_twin()) / settings_.reduced_traction.divisor;
  }

  /// True if the opposite surface has conditions of its own (two passes or self-contact).
  bool has_twin() const { return settings_.two_pass || may_meet_itself(); }
  /// True if the surface may be in contact with itself.
  bool may_meet_itself() const { return primary_.may_meet_itself(); }
  /// The condition between traction and gap.
  const NormalCondition& normal() const { return normal_condition(settings_.gap); }
  /// The condition between friction and slip in the present step.
  const TangentialCondition& tangential() const { return tangential_condition(effects_.acting_friction()); }
  const FrictionRule& friction() const { return settings_.friction; }
  /// The trial load lambda_n + eps_n g of a node [MPa], in contact or not, and its derivative with respect to the gap.
  LawValue traction_trial(Index node, double gap) const {
    return augmented(multipliers.traction[node], traction_penalty(node), gap);
  }
  /// The trial load that decides the initial status of a node. Surfaces without traction are in contact by their gaps,
  /// for any penalty.
  LawValue initial_trial(Index node, double gap) const;

  /// Sets traction and fluxes of the nodes in contact from gaps and jumps; if `with_penalty` is false, to the
  /// multipliers.
  void load(NodalLoads& loads, bool with_penalty) const;

  /// Uzawa's update: the loads become the multipliers, except at nodes that augmentations leave out. Multipliers of
  /// tractions that are not exchanged stay the same.
  void augment(const NodalLoads& loads);
  /// Accepts the loads and the status at the end of a step.
  void accept(const NodalLoads& loads);
  /// Tractions for the geometric part of the tangent at the start of a step: those given, limited by the largest
  /// accepted traction. A larger traction would come from a large penalty and an overlap that is not in equilibrium,
  /// such as an overlap of the initial meshes or of averages over other facets than before.
  VectorXd within_accepted(const VectorXd& traction, double surface_size) const;

  /// The traction that the rounding of gaps causes under the penalty [MPa].
  double traction_rounding(double surface_size) const;
  /// The rounding error of values and jumps per field. It comes from the field itself. The rounding error of the
  /// solvent's pressure also contains the stress that the rounding of positions causes, because the motion of the solid
  /// determines the pressure.
  VectorXd field_rounding(const FacingFields& fields, double surface_size) const;

  Multipliers multipliers;
  /// True if a step begins with contact at all nodes around points that overlap, or else at the nearest nodes: after an
  /// attempt that failed without contact, or before contact has borne a load. With too few nodes in contact, a body
  /// might be free to rotate. A closed node in tension opens again.
  bool close_overlapped = false;
  /// True if no node of either surface has displacements of its own.
  bool between_rigid_bodies = false;
  /// True if a rigid body of either surface can move and has no inertia. It may be supported by this contact only, and
  /// would move too far in a step that begins without a node in contact.
  bool holds_rigid_body = false;

 private:
  const SurfaceMesh& primary_;
  const SurfaceMesh& secondary_;
  const Effects& effects_;
  const Settings& settings_;
  Penalties penalties_;
  NodeFlags soft_;  ///< nodes whose gap no solution can change; empty if there is none or their penalties are as given
  IndexedVector<std::unique_ptr<ScalarCondition>> scalars_;  ///< condition per field
};

/// The stiffness of the adjoining elements over the traction penalty per node, at most 1 [-]; 1 between rigid bodies.
VectorXd stiffness_over_penalty(const NodalLaws& laws);

/// At the start of a step, sets the fluxes for the geometric part of the tangent to zero at nodes that were not
/// flux-coupled at the end of the last step. Their jumps are not caused by fluxes; times a large penalty they would
/// cause a large error of the tangent.
void drop_new_fluxes(const Multipliers& multipliers, MatrixXd& flux);

}  // namespace mixture_contact
