/// The tie of two surfaces: loads at tied nodes, residual, tangent and augmentation.
#pragma once

#include "conditions/penalty.h"
#include "enforcement/gap_measures.h"
#include "tie/breaking.h"
#include "tie/tied_node.h"

#include <functional>
#include <optional>

namespace mixture_contact {

/// Multipliers of the tied nodes, and factors of augmentations on penalties.
struct TieState {
  Matrix3Xd traction;  ///< lambda_a per tied node [MPa]
  MatrixXd flux;       ///< lambda per (field, tied node)
  double traction_penalty_scale = 1;
  VectorXd flux_penalty_scale;  ///< per field
  DamageState damage;
};

/// The gaps and loads of tied nodes at a state; one column per tied node.
struct TieLoads {
  Matrix3Xd gap;       ///< D_a [mm]
  Matrix3Xd traction;  ///< t_a on the primary surface [MPa]
  MatrixXd jump;       ///< (fields, nodes): primary less secondary side
  MatrixXd flux;       ///< (fields, nodes): out of the primary body
  Matrix3Xd turning;   ///< d psi/dn of the cohesive law [N/mm]; empty without it
  VectorXd damage;     ///< d at this state [-]; empty where a tie cannot break
};

/// Default multiples of the stiffness and the conductance of the adjoining elements. No kink of a tie asks for smaller
/// ones: gaps and jumps are far below the error of a mesh and still above the rounding of a linear solver.
inline constexpr double default_tie_factor = 1e6;
inline constexpr double default_tie_flux_factor = 1e7;
/// The default of a tie that softens, after Turon, Davila, Camanho and Costa (2007), Eng Fract Mech 74:1665-1682. A
/// stiffer bond is no more exact where it opens by the energy that breaks it, and an iteration that unloads it goes
/// wrong the farther.
inline constexpr double default_cohesive_factor = 50;
/// The largest factor that augmentations may reach: conditions that others nearly repeat close slowly at less.
inline constexpr double largest_tie_factor = 1e8;

class Tie {
 public:
  using AddResidual = std::function<void(const Patch&, const VectorXd&)>;
  /// Takes a square block of the tangent dR/du; it is symmetric unless damage grows.
  using AddTangent = std::function<void(const Patch&, const MatrixXd&)>;

  Tie(PerSide<SurfaceMesh> mesh, Effects effects, IndexedVector<TiedNode> nodes, BreakingLaw breaking = Unbreakable());

  /// Takes penalties and tolerances; multipliers stay. `breaking`: how bonds break in a step, of the type that they
  /// have; without it that stays, too.
  void set_laws(const Settings& settings, const std::optional<BreakingLaw>& breaking = std::nullopt);
  /// Takes the materials behind the facets, in the meshes, for automatic penalties.
  void set_meshes(PerSide<SurfaceMesh> mesh);

  const PerSide<SurfaceMesh>& mesh() const { return mesh_; }
  const Effects& effects() const { return effects_; }
  const Settings& settings() const { return settings_; }
  const IndexedVector<TiedNode>& nodes() const { return nodes_; }
  const Penalties& penalties() const { return penalties_; }
  const BreakingLaw& breaking() const { return breaking_; }
  /// The penalty of a node's traction [N/mm^3]; 0 where multipliers are unknown.
  double traction_penalty(Index n) const;
  bool has_unknown_multipliers() const { return settings_.enforcement == Enforcement::lagrange_multipliers; }

  /// The unknowns of a node's traction, or of the flux of a field. Its multiplier_node counts tied nodes.
  Patch patch(Index n) const;
  Patch patch(Index n, int field) const;
  /// Calls use(patch) for the traction and the fluxes of all nodes.
  void for_each_patch(const std::function<void(const Patch&)>& use) const;

  TieLoads loads(const PerSide<SurfaceFields>& fields) const;
  /// Hands out R of each node: forces -A_a W_aj t_a, flows times dt, and -A_a k D_a of unknown multipliers.
  void residual(const PerSide<SurfaceFields>& fields, double dt, const AddResidual& add) const;
  /// `softening`: the part of the softening of growing damage that it includes; 1: all, the true derivative; 0: such
  /// bonds yield (yielding_derivative()).
  void tangent(const PerSide<SurfaceFields>& fields, double dt, double softening, const AddTangent& add) const;

  /// How well a solution meets its conditions (see GapSums).
  GapReport gaps(const PerSide<SurfaceFields>& fields) const;
  /// Has multipliers take the loads of a solution up, and fields that miss their tolerances get tenfold penalties, up
  /// to the automatic ones. Returns whether any has grown.
  bool augment(const PerSide<SurfaceFields>& fields);

  const TieState& state() const { return state_; }
  void restore(TieState state) { state_ = std::move(state); }

  /// Unknown multipliers over the stiffness or conductance of the adjoining elements: three of a node's traction, then
  /// those of the fields that it exchanges, node by node.
  VectorXd unknowns() const;
  void set_unknowns(const VectorXd& values);
  /// How many there are; 0 where multipliers are not unknown.
  Index unknown_count() const { return has_unknown_multipliers() ? first_.back() : 0; }
  /// The unknown of a field's flux; without a field the first one of the traction.
  Index unknown(Index n, std::optional<int> field = std::nullopt) const;

 private:
  double flux_penalty(Index n, int field) const;
  VectorXd flux_residual(Index n, int field, const TieLoads& loads) const;
  MatrixXd traction_tangent(Index n, const FacingPositions& x, const TieLoads& loads, double softening) const;
  MatrixXd flux_tangent(Index n, int field) const;
  /// Calls use(patch, make(node, field)) for the traction, field -1, and the fluxes of all nodes in order; makes them
  /// on several threads.
  template <class Values, class Make, class Use>
  void for_each_part(const Make& make, const Use& use) const;

  PerSide<SurfaceMesh> mesh_;
  Effects effects_;
  Settings settings_;
  IndexedVector<TiedNode> nodes_;
  BreakingLaw breaking_;
  IndexedVector<Index> first_;  ///< per node the first of its unknown multipliers; behind them all, how many there are
  Penalties penalties_;         ///< per node of the primary surface
  TieState state_;
};

}  // namespace mixture_contact
