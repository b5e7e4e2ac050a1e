/// First variations of nodal averages, and the linearisation point of an iteration.
#pragma once

#include "mortar/mortar_space.h"

namespace mixture_contact {

/// First variations of a node's averages and the virtual work of its loads, as local vectors of the patch around the
/// node. If multipliers are unknowns, every node has a patch; that of an open node contains its multipliers only.
struct NodeLinearisation {
  /// First variation of the average jump of one field. `weights` times the node's flux_area is also the virtual work of
  /// a unit flux.
  struct Jump {
    VectorXd projection_variation;  ///< derivative djump/du, in the order of gap_variation
    /// Derivatives of the jump with respect to the field's nodal values, in the order of patch.of_field(field, false).
    VectorXd weights;
  };
  /// First variations of the averages on which friction depends; empty without friction. Rows are vector components.
  struct Friction {
    /// Derivatives of s_a and of NodalFriction::area_vector, in this order, with the position of each node of the
    /// patch.
    IndexedVector<Eigen::Matrix<double, 6, 3>> average_variation;
    VectorXd area_variation;    ///< derivative of the node's area, in the order of gap_variation
    Matrix3Xd trial_variation;  ///< derivative dtau_a/du of the trial friction, columns in the order of gap_variation
    Matrix3Xd convection;       ///< coefficients C_b of F_a = sum_b x_b C_b^T, over the primary nodes of the patch
    /// Virtual work of a unit friction traction, sum_q w psi_a |a| h, one entry per node of the patch.
    VectorXd work;
    VectorXd pressure_variation;  ///< derivative d(p~ - p*)/du at fixed nodal values, in the order of gap_variation
    /// Derivative of p~ - p* with respect to the nodal values of p~, one per node of the patch; empty without fluid.
    VectorXd pressure_weights;

    /// The number of nodes, from the first of the patch, on which the mean normal or the node's area depends: all nodes
    /// if points move on their facets, else the primary ones. The remaining nodes affect the slip only.
    Index turning = 0;
    int pressure_field = 0;  ///< index of the pressure in the order of Effects

    bool empty() const { return work.size() == 0; }
    bool has_fluid() const { return pressure_weights.size() > 0; }
  };
  /// The nodes and fields of the averages.
  Patch patch;
  VectorXd gap_variation;     ///< derivative dg_a/du of the average gap, in the order of patch.of_displacements()
  VectorXd traction_work;     ///< virtual work of a unit traction, sum_q w psi_a h a, in the same order
  IndexedVector<Jump> jumps;  ///< average jumps, one per field of the patch, in the patch's order
  Friction friction;

  bool empty() const { return patch.primary.empty() && !patch.multiplier_node; }
};

/// First variations of the averages of all nodes in contact. The entries of other nodes are empty.
IndexedVector<NodeLinearisation> linearise(const MortarSpace& space, const NodalLoads& loads,
                                           const FacingFields& fields);

/// The part of a node's average jump that depends on nodal values, for the k-th field of its patch. `fields`: the nodal
/// values, or their changes for the change of the jump. The part of the displacements is not included.
double jump_of(const NodeLinearisation& linear, Index k, const FacingFields& fields);

/// The change of the convection F_a of a node (slips.h) by displacements `moved`, in the order of gap_variation.
Eigen::Matrix3d convection_change(const NodeLinearisation& linear, const VectorXd& moved);

/// The state at which an iteration linearises. Within the iteration and its line search, averages are linear functions
/// of the unknowns around it.
struct LinearisationPoint {
  SurfaceFields primary;  ///< positions and fields of the primary surface
  SurfaceFields secondary;
  NodalLoads loads;  ///< nodal loads at the state
  /// One per node; entries of nodes out of contact are empty; no entries at all if only the loads are held.
  IndexedVector<NodeLinearisation> nodes;
  VectorXd geometric_traction;  ///< normal tractions t_a in the geometric part of the tangent
  MatrixXd geometric_flux;      ///< fluxes in the geometric part of the tangent
  /// Friction tractions t_T in the geometric part of the tangent; empty without friction.
  Matrix3Xd geometric_friction;
  VectorXd equation_weights;  ///< weights of the equations of unknown multipliers
  /// Per node, the part of beyond_linear() that the predicted averages include: the stiffness of the elements over the
  /// penalty, at most 1 [-]. In the next iteration the elements follow this motion, which then causes a traction of
  /// their stiffness, not of the penalty.
  VectorXd beyond_part;

  bool is_linearised() const { return !nodes.empty(); }
  /// True if the fields equal those of this state, so that the predicted change is zero.
  bool is_at(const FacingFields& fields) const;
  /// The linearised averages at another state, with the contact status and loads of this state.
  NodalLoads predicted_averages(const FacingFields& fields) const;
  /// Memory of the point [bytes].
  std::size_t memory() const;
};

}  // namespace mixture_contact
