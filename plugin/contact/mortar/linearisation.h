/// First variations of nodal averages, and the linearisation point of an iteration.
#pragma once

#include "mortar/corner_point.h"

#include <functional>

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
  /// The nodes and fields of the averages.
  Patch patch;
  VectorXd gap_variation;     ///< derivative dg_a/du of the average gap, in the order of patch.of_displacements()
  VectorXd traction_work;     ///< virtual work of a unit traction, sum_q w psi_a h a, in the same order
  IndexedVector<Jump> jumps;  ///< average jumps, one per field of the patch, in the patch's order
  SlipLinearisation friction;

  bool empty() const { return patch.primary.empty() && !patch.multiplier_node; }
};

/// First variations of the averages of all nodes in contact. The entries of other nodes are empty.
IndexedVector<NodeLinearisation> linearise(const MortarSpace& space, const NodalLoads& loads,
                                           const FacingFields& fields);

/// Receives a pair that carries load: its index and its variations.
using UseVaryingPair = std::function<void(Index pair, const VaryingPair& varying)>;

/// Linearises the averages of the nodes in contact, as linearise() does, and calls `use` once for each pair that
/// carries load, on several threads. The pairs passed to `use` have the loads `carried` and a time increment of 1.
IndexedVector<NodeLinearisation> linearise(const MortarSpace& space, const NodalLoads& loads,
                                           const FacingFields& fields, const NodalLoads& carried,
                                           const UseVaryingPair& use);

/// The part of a node's average jump that depends on nodal values, for the k-th field of its patch. `fields`: the nodal
/// values, or their changes for the change of the jump. The part of the displacements is not included.
double jump_of(const NodeLinearisation& linear, Index k, const FacingFields& fields);

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
  /// their stiffness, not of the penalty. Empty without rigid bodies.
  VectorXd beyond_part;

  /// Sets the loads in the geometric part of the tangent.
  void set_geometric(const NodalLoads& from) {
    geometric_traction = from.traction;
    geometric_flux = from.flux;
    geometric_friction = from.friction.traction;
  }
  bool is_linearised() const { return !nodes.empty(); }
  /// True if the fields equal those of this state, so that the predicted change is zero.
  bool is_at(const FacingFields& fields) const;
  /// The linearised averages at another state, with the contact status and loads of this state.
  NodalLoads predicted_averages(const SlipAverages& slips, const FacingFields& fields) const;
  /// Memory of the point [bytes].
  std::size_t memory() const;
};

}  // namespace mixture_contact
