/// Averages and loads at the nodes of the surface over which a pass integrates.
#pragma once

#include "base/indexed_vector.h"

namespace mixture_contact {

/// Averages of the gap around nodes: g_a = INT psi_a g da / INT psi_a da.
struct NodalGaps {
  VectorXd area;      ///< tributary area INT psi_a da over the points that face the other surface [mm^2]
  VectorXd gap;       ///< average gap g_a [mm]
  double size = 0;    ///< size of the surface, to which the rounding of gaps is proportional [mm]
  double offset = 0;  ///< distance of the surfaces at which the gap g_a is zero [mm]

  /// True if a point around the node faces the other surface.
  bool faces(Index node) const { return area[node] > 0; }
};

/// The contact status of nodes.
struct ContactStatus {
  NodeFlags in_contact;
  /// Nodes in contact that exchange fluxes with the other side; the others have ambient values.
  NodeFlags flux_coupled;
  /// Nodes in contact that slide; empty before the decision, and without friction.
  NodeFlags slips = {};  // NOLINT(readability-redundant-member-init): so that lists of initial values may leave it out
  /// Nodes in contact with a positive friction bound T_max, where the load exceeds that of the fluid; empty as `slips`.
  NodeFlags rubs = {};  // NOLINT(readability-redundant-member-init)

  /// True if the status of a node is stick.
  bool sticks(Index node) const { return !slips.empty() && !slips[node]; }
};

/// The friction status of nodes: ContactStatus::slips and ContactStatus::rubs.
struct FrictionStatus {
  NodeFlags slips;
  NodeFlags rubs;

  /// True if nodes have another status.
  bool differs_from(const ContactStatus& other) const { return slips != other.slips || rubs != other.rubs; }
};

/// Averages around nodes in contact on which friction depends, and the friction that the law gives; empty without
/// friction.
///
/// The slip s_a refers to the configuration at the start of the step; F_a maps it to the present tangent plane.
struct NodalFriction {
  Matrix3Xd slip;         ///< average slip s_a [mm]
  Matrix3Xd area_vector;  ///< average area vector, INT psi_a n da / INT psi_a da
  VectorXd pressure;      ///< average excess p~ - p* of the pressure [MPa]; empty if friction does not depend on it
  IndexedVector<Eigen::Matrix3d> convection;  ///< deformation F_a of the surface since the start of the step
  Matrix3Xd trial;                            ///< trial friction tau_a [MPa]
  Matrix3Xd reference;       ///< trial friction tau_a at the start of the iteration; empty outside iterations
  VectorXd reference_bound;  ///< friction bound T_max at the start of the iteration
  Matrix3Xd geometric;  ///< vector lambda_T - eps_T s_a for the geometric part of the tangent; empty outside iterations
  VectorXd bound;       ///< friction bound T_max [MPa]
  Matrix3Xd traction;   ///< friction traction t_T [MPa]; 0 out of contact

  /// The trial at the start of the iteration; outside iterations the present trial.
  Vector3d reference_of(Index node) const { return (reference.size() > 0 ? reference : trial).col(node); }
  /// The bound at the start of the iteration; outside iterations the present bound.
  double reference_bound_of(Index node) const {
    return reference_bound.size() > 0 ? reference_bound[node] : bound[node];
  }
  /// The mean unit normal n_a.
  Vector3d normal(Index node) const { return area_vector.col(node).normalized(); }
};

/// The loads at the nodes of a primary surface by the laws (2.7)-(2.9), from the averages of gap, jumps and slip around
/// each node. The functions psi_a interpolate tractions and fluxes between nodes.
///
/// The laws hold at nodes and not at integration points, because two surfaces can meet only as many conditions as one
/// of them has nodes. On non-matching meshes, conditions at more points contradict each other, and some points open and
/// close alternately.
struct NodalLoads : NodalGaps, ContactStatus {
  VectorXd traction;  ///< normal traction t_a [MPa]; 0 out of contact
  /// Area INT psi_a da over the points at which both sides have the field, shape (fields, nodes) [mm^2].
  MatrixXd flux_area;
  MatrixXd jump;  ///< average jump, primary minus secondary side, shape (fields, nodes)
  MatrixXd flux;  ///< flux from the primary to the secondary body, shape (fields, nodes); 0 out of contact
  NodalFriction friction;
  /// Values of the fields at the nodes of the primary surface, shape (fields, nodes).
  MatrixXd own = {};  // NOLINT(readability-redundant-member-init): so that lists of initial values may leave it out

  const ContactStatus& status() const { return *this; }
  /// True if a node exchanges a field with the other side.
  bool exchanges(Index field, Index node) const { return flux_coupled[node] && flux_area(field, node) > 0; }
};

/// The change of tractions and fluxes from `from` to `to`, at all nodes that are in contact in one of them. The virtual
/// work (2.5) is linear in both, so that these loads give its change.
NodalLoads change(const NodalLoads& from, const NodalLoads& to);

}  // namespace mixture_contact
