/// First variations of nodal averages, and their state in an iteration.
#pragma once

#include "mortar/mortar_space.h"

namespace mixture_contact {

/// First variations of a node's averages and the virtual work of its loads, as local vectors of the patch around it. If
/// multipliers are unknowns, every node has one; an open node has that of its multipliers alone.
struct NodeLinearisation {
  /// First variation of the jump of one field. The virtual work of its flux is `weights` times the node's flux_area.
  struct Jump {
    VectorXd projection_variation;  ///< djump/du, in the order of gap_variation
    VectorXd weights;               ///< with the field's nodal values, in the order of patch.of_field(field, false)
  };
  /// First variations of the averages that friction depends on; empty without friction. Rows are components.
  struct Friction {
    /// Derivatives of s_a and of NodalFriction::area_vector, in this order, with the position of each node of the
    /// patch.
    IndexedVector<Eigen::Matrix<double, 6, 3>> average_variation;
    VectorXd area_variation;      ///< of the node's area, in the order of gap_variation
    Matrix3Xd trial_variation;    ///< dtau_a/du, columns alike
    Matrix3Xd convection;         ///< C_b: F_a = sum_b x_b C_b^T over the primary nodes of the patch
    VectorXd work;                ///< sum_q w psi_a |a| h, one per node of the patch: times t_T the virtual work
    VectorXd pressure_variation;  ///< d(p~ - p*)/du at fixed nodal values, in the order of gap_variation
    VectorXd pressure_weights;    ///< with the values of p~, one per node of the patch; empty without fluid

    /// Number of first nodes of the patch that turn the mean normal or change the node's area: all if points move over
    /// their facets, else the primary ones. Other nodes change the slip alone.
    Index turning = 0;
    int pressure_field = 0;  ///< index by Effects

    bool empty() const { return work.size() == 0; }
    bool has_fluid() const { return pressure_weights.size() > 0; }
  };
  Patch patch;
  VectorXd gap_variation;     ///< dg_a/du, in the order of patch.of_displacements()
  VectorXd traction_work;     ///< sum_q w psi_a h a, in the same order
  IndexedVector<Jump> jumps;  ///< per field of the patch
  Friction friction;

  bool empty() const { return patch.primary.empty() && !patch.multiplier_node; }
};

/// Linearises the averages of the nodes in contact. The entries of other nodes are empty.
IndexedVector<NodeLinearisation> linearise(const MortarSpace& space, const NodalLoads& loads,
                                           const FacingFields& fields);

/// The jump of the k-th field of a node's patch, or its change, with the values of the field or their changes; without
/// the part of the displacements.
double jump_of(const NodeLinearisation& linear, Index k, const FacingFields& fields);

/// The variation of F_a of a node by displacements in the order of gap_variation.
Eigen::Matrix3d convection_change(const NodeLinearisation& linear, const VectorXd& moved);

/// The point at which an iteration linearises: averages are linear in the unknowns within the iteration and its line
/// search.
struct LinearisationPoint {
  SurfaceFields primary;  ///< the state
  SurfaceFields secondary;
  NodalLoads loads;                        ///< there
  IndexedVector<NodeLinearisation> nodes;  ///< empty for nodes out of contact; none where loads alone are held
  VectorXd geometric_traction;             ///< t_a for the geometric part of the tangent
  MatrixXd geometric_flux;                 ///< fluxes for it
  Matrix3Xd geometric_friction;            ///< t_T for it; empty without friction
  VectorXd equation_weights;               ///< of the equations of unknown multipliers

  bool is_linearised() const { return !nodes.empty(); }
  /// Whether fields equal those of the point, so that the predicted change is zero.
  bool is_at(const FacingFields& fields) const;
  /// The linearised averages at another state, with status and loads of the point.
  NodalLoads predicted_averages(const FacingFields& fields) const;
  std::size_t memory() const;
};

}  // namespace mixture_contact
