/// The laws at the nodes of a surface: penalties, multipliers, and the loads that they make of gaps and jumps.
#pragma once

#include "law/nodal_loads.h"
#include "law/penalty.h"

namespace mixture_contact {

/// Multipliers of the nodes of the primary surface: the state that only an augmentation changes, or, where multipliers
/// are unknowns, the host with every trial state.
struct Multipliers {
  VectorXd traction;                  ///< lambda_n per node [MPa]
  MatrixXd flux;                      ///< lambda per (field, node)
  double traction_penalty_scale = 1;  ///< factor on eps_n that slow augmentations have built up
  VectorXd flux_penalty_scale;        ///< the same per field
};

/// Rounding of averaged gaps and jumps, over the size of the surface or the field.
inline constexpr double rounding_fraction = 1e-13;

class NodalLaws {
 public:
  /// Keeps references to the surfaces and what they exchange.
  NodalLaws(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects, const Settings& settings);

  /// Recomputes the penalties after the properties of the surfaces have changed.
  void update_penalties();

  const Effects& effects() const { return effects_; }
  Index nodes() const { return primary_.nodes; }
  /// Penalties of the nodes.
  const Penalties& penalties() const { return penalties_; }
  double traction_penalty(Index node) const { return multipliers.traction_penalty_scale * penalties_.traction[node]; }
  double flux_penalty(Index field, Index node) const {
    return multipliers.flux_penalty_scale[field] * penalties_.flux(field, node);
  }

  // The largest multiples of stiffness and conductance that augmentations may bring penalties to
  double largest_traction_factor() const {
    return (has_twin() ? two_pass_traction_factor : default_traction_factor) / settings_.traction_reduction;
  }
  double largest_flux_factor() const { return has_twin() ? two_pass_flux_factor : default_flux_factor; }

  /// Whether nodes in contact may pull.
  bool bear_tension() const { return settings_.tension; }
  /// Tractions as the laws admit them.
  VectorXd admissible(const VectorXd& traction) const { return bear_tension() ? traction : traction.cwiseMin(0.0); }

  /// Sets traction and fluxes of the nodes in contact to lambda + eps times gap or jump; without penalty, to lambda.
  void load(NodalLoads& loads, bool with_penalty) const;

  /// What a large penalty makes of the rounding of gaps [MPa].
  double traction_rounding(double surface_size) const;
  /// Per field; values and jumps below this are rounding: of the field itself and, as the solvent's pressure comes from
  /// the motion of the solid, of the stress that rounding of positions makes of the stiffness.
  VectorXd field_rounding(const FacingFields& fields, double surface_size) const;

  Multipliers multipliers;

 private:
  /// Whether the surface that these nodes face has conditions of its own.
  bool has_twin() const { return settings_.two_pass || primary_.may_meet_itself(); }

  const SurfaceMesh& primary_;
  const SurfaceMesh& secondary_;
  const Effects& effects_;
  const Settings& settings_;
  Penalties penalties_;
};

}  // namespace mixture_contact
