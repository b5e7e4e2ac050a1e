/// The laws at the nodes of a surface: penalties, multipliers, and loads from gaps and jumps.
#pragma once

#include "conditions/friction.h"
#include "conditions/membrane.h"
#include "conditions/nodal_loads.h"
#include "conditions/normal.h"
#include "conditions/penalty.h"

namespace mixture_contact {

/// Multipliers of the nodes of the primary surface: the state that only an augmentation changes, or, where multipliers
/// are unknowns, the host with every trial state.
struct Multipliers {
  VectorXd traction;                  ///< lambda_n per node [MPa]
  MatrixXd flux;                      ///< lambda per (field, node)
  double traction_penalty_scale = 1;  ///< factor on eps_n that slow augmentations have built up
  VectorXd flux_penalty_scale;        ///< the same per field
  VectorXd accepted_traction;         ///< t_a of the step that was accepted last [MPa]; 0 before any
  NodeFlags flux_coupled;             ///< flux-coupled nodes of that step; none before any, empty without fluxes
  Matrix3Xd friction;                 ///< lambda_T per node, as the surfaces lay when the step began [MPa]; empty
                                      ///< without friction
  NodeFlags slips;                    ///< sliding nodes at this friction
  double friction_penalty_scale = 1;  ///< as traction_penalty_scale, of the tangential penalty
};

/// A node's trial traction with the factors of its variation.
struct FrictionTrial {
  Vector3d normal;   ///< n_a
  Vector3d past;     ///< lambda_T - eps_T s_a, as the surfaces lay when the step began
  Vector3d carried;  ///< F_a of it
  Vector3d value;    ///< tau_a = (1 - n_a n_a) F_a (lambda_T - eps_T s_a)
};

/// The trial of a vector `past`, which lies in the plane that slips are measured in, carried into the present tangent
/// plane.
FrictionTrial carried_trial(const NodalFriction& friction, Index node, const Vector3d& past);

/// Friction of a node in contact by its status.
FrictionTraction friction_law(const NodalLoads& loads, Index node);

/// Rounding of averaged gaps and jumps, over the size of the surface or the field.
inline constexpr double rounding_fraction = 1e-13;

/// A step may begin with tractions that have changed since the last one was accepted by twice the change then accepted
/// (see ActiveSetOptions::solution_load), as a part of the largest one.
inline constexpr double accepted_margin = 2e-2;

class NodalLaws {
 public:
  /// Keeps references to the surfaces and their effects.
  NodalLaws(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects, const Settings& settings);

  /// Drops accepted steps: their tractions, friction, stick and slip, and flux-coupled nodes.
  void forget_steps();
  /// Recomputes the penalties after the properties of the surfaces, or settings, have changed.
  void update_penalties();

  const Effects& effects() const { return effects_; }
  Index nodes() const { return primary_.nodes; }
  /// Penalties of the nodes.
  const Penalties& penalties() const { return penalties_; }
  double traction_penalty(Index node) const { return multipliers.traction_penalty_scale * penalties_.traction[node]; }
  double flux_penalty(Index field, Index node) const {
    return multipliers.flux_penalty_scale[field] * penalties_.flux(field, node);
  }

  /// The condition of a field.
  const ScalarCondition& scalar(Index field) const { return *scalars_[field]; }
  /// The law or multiplier that enforces it at a node.
  Enforcing enforcing(Index field, Index node) const {
    return {multipliers.flux(field, node), flux_penalty(field, node)};
  }

  double friction_penalty(Index node) const {
    return multipliers.friction_penalty_scale * settings_.friction.penalty_factor * penalties_.traction[node];
  }
  /// Friction penalties of all nodes, before slow augmentations have built them up.
  VectorXd friction_penalties() const { return settings_.friction.penalty_factor * penalties_.traction; }

  // Limits of augmented penalties, as multiples of stiffness and conductance
  double largest_traction_factor() const {
    return normal().penalty_factor(has_twin()) / settings_.reduced_traction.divisor;
  }

  /// Whether the surface that these nodes face has conditions of its own.
  bool has_twin() const { return settings_.two_pass || may_meet_itself(); }
  /// Whether the surface may meet itself.
  bool may_meet_itself() const { return primary_.may_meet_itself(); }
  /// The condition between traction and gap.
  const NormalCondition& normal() const { return normal_condition(settings_.gap); }
  /// lambda_n + eps_n g of a node [MPa], whether or not it is in contact, and its derivative with the gap.
  LawValue traction_trial(Index node, double gap) const {
    return augmented(multipliers.traction[node], traction_penalty(node), gap);
  }

  /// Sets traction and fluxes of the nodes in contact by their conditions from gaps and jumps; without penalty, to
  /// lambda.
  void load(NodalLoads& loads, bool with_penalty) const;

  FrictionTrial friction_trial(const NodalFriction& friction, Index node) const;
  FrictionBound friction_bound(const NodalLoads& loads, Index node) const;
  /// The bound without <>: its sign decides whether a node has a positive friction bound.
  double rubbing(const NodalLoads& loads, Index node) const;
  /// Sets bound and friction of the nodes in contact by their status.
  void load_friction(NodalLoads& loads) const;
  /// Sets the reference of friction in an iteration that begins with status and trials of `loads`: the trials and
  /// bounds that the last one predicted, or its own. Friction of a node that closes after an iteration does not turn:
  /// the bound that its overlap makes is as much too large as the penalty is.
  void refer_friction(NodalLoads& loads, const NodalLoads* predicted) const;
  /// Nodes in contact that slide before any decision: those whose trial exceeds the bound.
  NodeFlags beyond_bound(const NodalLoads& loads) const;
  /// Multipliers of friction whose trial equals the present tractions without further slip.
  Matrix3Xd friction_multipliers(const NodalFriction& friction) const;
  /// Accepts the present friction and status.
  void take_friction(const NodalLoads& loads);
  /// The start of a step: tractions for the geometric part of the tangent, none larger than in the equilibrium that the
  /// last one ended with. A larger one comes from a large penalty and an overlap in no equilibrium: of meshes at the
  /// start, or where averages are taken over other facets than before.
  VectorXd within_accepted(const VectorXd& traction, double surface_size) const;

  /// The traction from the rounding of gaps under a large penalty [MPa].
  double traction_rounding(double surface_size) const;
  /// Rounding of values and jumps per field. It comes from the field itself and, for the solvent's pressure, from the
  /// stress by rounding of positions, because the motion of the solid determines this pressure.
  VectorXd field_rounding(const FacingFields& fields, double surface_size) const;

  Multipliers multipliers;
  /// Whether an attempt at a step begins in contact around all points that overlap: after an attempt that failed
  /// without contact, or before contact has borne a load. With too few nodes, a body may be free to turn. A closed node
  /// that is pulled opens again.
  bool close_overlapped = false;
  /// Whether no node of either surface has displacements of its own.
  bool between_rigid_bodies = false;
  /// Whether a rigid body of either surface is free to move and has no inertia: it may have the stiffness of this
  /// contact alone, and a step that begins without a node in contact would move it too far.
  bool holds_rigid_body = false;

 private:
  /// Sets the trials, and bound and status before their first decision.
  void find_friction_limits(NodalLoads& loads) const;

  const SurfaceMesh& primary_;
  const SurfaceMesh& secondary_;
  const Effects& effects_;
  const Settings& settings_;
  Penalties penalties_;
  IndexedVector<std::unique_ptr<ScalarCondition>> scalars_;  ///< per field
};

/// Begins a step: sets fluxes to zero at nodes that were not flux-coupled when the last one ended, for the geometric
/// part of the tangent. Their jump does not come from fluxes. Multiplied by a large penalty, it would be a large error
/// of the stiffness.
void drop_new_fluxes(const Multipliers& multipliers, MatrixXd& flux);

}  // namespace mixture_contact
