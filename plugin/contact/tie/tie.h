/// The tie of two surfaces: loads at tied nodes, residual, tangent and augmentation.
#pragma once

#include "conditions/penalty.h"
#include "enforcement/gap_measures.h"
#include "tie/breaking.h"
#include "tie/tied_node.h"

#include <functional>
#include <optional>

namespace mixture_contact {

/// Multipliers of the tied nodes, factors by which augmentations have increased the penalties, and damage.
struct TieState {
  Matrix3Xd traction;                 ///< traction multiplier lambda_a per tied node [MPa]
  MatrixXd flux;                      ///< flux multiplier lambda per (field, tied node)
  double traction_penalty_scale = 1;  ///< factor by which augmentations have increased the traction penalties
  VectorXd flux_penalty_scale;        ///< factors by which augmentations have increased the flux penalties, per field
  DamageState damage;
};

/// The gap vectors, jumps and loads of the tied nodes at a state; one column per tied node.
struct TieLoads {
  Matrix3Xd gap;       ///< gap vectors D_a [mm]
  Matrix3Xd traction;  ///< tractions t_a on the primary surface [MPa]
  MatrixXd jump;       ///< jump, primary minus secondary side, shape (fields, nodes)
  MatrixXd flux;       ///< flux out of the primary body, shape (fields, nodes)
  Matrix3Xd turning;   ///< derivative d psi/dn of the cohesive law's energy [N/mm]; no columns for other laws
  VectorXd damage;     ///< damage d at this state [-]; empty if the tie cannot break
};

/// Default penalties of a tie as multiples of the stiffness and of the conductance of the adjoining elements. A tie has
/// no change of status that would require smaller factors. Gaps and jumps are then far below the error of a mesh, and
/// still above the rounding of a linear solver.
inline constexpr double default_tie_factor = 1e6;
inline constexpr double default_tie_flux_factor = 1e7;
/// Default penalty factor of a cohesive tie (Turon, Davila, Camanho and Costa 2007, Eng Fract Mech 74:1665-1682). A
/// stiffer bond would not be more accurate, because its opening is given by the fracture energy, but iterations with
/// unloading bonds would converge worse.
inline constexpr double default_cohesive_factor = 50;
/// Largest penalty factor that augmentations may reach. Conditions that are almost redundant close only slowly with
/// smaller penalties.
inline constexpr double largest_tie_factor = 1e8;

/// A tie of two surfaces with its multipliers and damage. It computes loads, residual and tangent of the tied nodes.
class Tie {
 public:
  /// Receives the residual of a patch.
  using AddResidual = std::function<void(const Patch&, const VectorXd&)>;
  /// Receives a square block of the tangent dR/du of a patch; the block is symmetric unless damage grows.
  using AddTangent = std::function<void(const Patch&, const MatrixXd&)>;

  Tie(PerSide<SurfaceMesh> mesh, Effects effects, IndexedVector<TiedNode> nodes, BreakingLaw breaking = Unbreakable());

  /// Sets penalties and tolerances and keeps the multipliers. Augmentations begin again. `breaking`: the parameters by
  /// which bonds break in the step, of the same type as before; without it they stay the same.
  void set_laws(const Settings& settings, const std::optional<BreakingLaw>& breaking = std::nullopt);
  /// Sets the meshes with the materials behind the facets, which automatic penalties depend on.
  void set_meshes(PerSide<SurfaceMesh> mesh);

  const PerSide<SurfaceMesh>& mesh() const { return mesh_; }
  const Effects& effects() const { return effects_; }
  const Settings& settings() const { return settings_; }
  const IndexedVector<TiedNode>& nodes() const { return nodes_; }
  const Penalties& penalties() const { return penalties_; }
  const BreakingLaw& breaking() const { return breaking_; }
  /// The penalty of a node's traction [N/mm^3]; 0 if the multipliers are unknowns.
  double traction_penalty(Index n) const;
  /// True if the multipliers are unknowns of the equation system.
  bool has_unknown_multipliers() const { return settings_.enforcement == Enforcement::lagrange_multipliers; }

  /// The unknowns on which a node's traction depends. The patch's multiplier_node is the number of the tied node.
  Patch patch(Index n) const;
  /// The unknowns on which a node's flux of a field depends.
  Patch patch(Index n, int field) const;
  /// Calls use(patch) for the traction and for each flux of all nodes that couple the surfaces. A broken node does so
  /// only by the equations of its multipliers, if they are unknowns.
  void for_each_patch(const std::function<void(const Patch&)>& use) const;

  /// The gaps and loads of all tied nodes at a state.
  TieLoads loads(const PerSide<SurfaceFields>& fields) const;
  /// Calls `add` with the residual R of each node: forces -A_a W_aj t_a, flows times dt, and -A_a k D_a for unknown
  /// multipliers.
  void residual(const PerSide<SurfaceFields>& fields, double dt, const AddResidual& add) const;
  /// Calls `add` with the tangent dR/du of each node. `softening`: the part of the softening of growing damage that the
  /// tangent includes.
  void tangent(const PerSide<SurfaceFields>& fields, double dt, const Softening& softening,
               const AddTangent& add) const;

  /// The errors of a solution in the conditions of the tie, relative to the loads (see GapSums).
  GapReport gaps(const PerSide<SurfaceFields>& fields) const;
  /// Sets the multipliers to the loads of a solution. Multiplies the penalties of fields that miss their tolerances by
  /// ten, up to a largest factor, if the last augmentation has not reduced the error to a quarter (Bertsekas 1982,
  /// Constrained Optimization and Lagrange Multiplier Methods, section 2.2). Returns true if a penalty was increased.
  bool augment(const PerSide<SurfaceFields>& fields);

  const TieState& state() const { return state_; }
  void restore(TieState state) { state_ = std::move(state); }

  /// The unknown multipliers, divided by the stiffness or conductance of the adjoining elements. Per node: three for
  /// its traction, then one per field that it exchanges.
  VectorXd unknowns() const;
  /// Sets the multipliers from the values of unknowns().
  void set_unknowns(const VectorXd& values);
  /// The number of unknown multipliers; 0 if the multipliers are not unknowns.
  Index unknown_count() const { return has_unknown_multipliers() ? first_.back() : 0; }
  /// The index of the unknown multiplier of a field's flux at a node; without a field, the first one of the traction.
  Index unknown(Index n, std::optional<int> field = std::nullopt) const;

 private:
  double flux_penalty(Index n, int field) const;
  VectorXd flux_residual(Index n, int field, const TieLoads& loads) const;
  MatrixXd traction_tangent(Index n, const FacingPositions& x, const TieLoads& loads, const Softening& softening) const;
  MatrixXd flux_tangent(Index n, int field) const;
  /// Calls use(patch, make(node, field)) for the traction (field -1) and the fluxes of all nodes in order. `make` runs
  /// on several threads.
  template <class Values, class Make, class Use>
  void for_each_part(const Make& make, const Use& use) const;

  PerSide<SurfaceMesh> mesh_;
  Effects effects_;
  Settings settings_;
  IndexedVector<TiedNode> nodes_;
  BreakingLaw breaking_;
  /// Per node, index of its first unknown multiplier; last entry: the number of all unknown multipliers.
  IndexedVector<Index> first_;
  Penalties penalties_;  ///< penalties per node of the primary surface
  TieState state_;
  std::optional<GapReport> last_gaps_;  ///< errors at the last augmentation since set_laws()
};

/// True if forces of one direction depend on displacements of others: with kept gaps, which turn with the bodies, and
/// with cohesive bonds. Otherwise each direction has a tangent of its own.
bool couples_directions(const Tie& tie);

}  // namespace mixture_contact
