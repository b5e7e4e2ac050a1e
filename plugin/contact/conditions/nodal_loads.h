/// The loads that the laws give at the nodes of the surface that a pass integrates over.
#pragma once

#include "base/indexed_vector.h"

namespace mixture_contact {

/// Averages of the gap around nodes: g_a = INT psi_a g da / INT psi_a da.
struct NodalGaps {
  VectorXd area;      ///< tributary area INT psi_a da, over points that face the other surface [mm^2]
  VectorXd gap;       ///< g_a [mm]
  double size = 0;    ///< of the surface, by which rounding of its positions is measured [mm]
  double offset = 0;  ///< zero of the gaps: distance of the surfaces - offset [mm]

  /// Whether a point around the node faces the other surface.
  bool faces(Index node) const { return area[node] > 0; }
};

/// The status of nodes.
struct ContactStatus {
  NodeFlags in_contact;
  NodeFlags flux_coupled;  ///< in contact, exchanging fluxes with the other side instead of the ambient
  /// In contact, and sliding; empty before the decision, and without friction.
  NodeFlags slips = {};  // NOLINT(readability-redundant-member-init): so that lists of initial values may leave it out
  /// In contact, with a load above that of the fluid, so that T_max is not 0; empty as `slips`.
  NodeFlags rubs = {};  // NOLINT(readability-redundant-member-init)
};

/// The decisions about friction at the nodes: ContactStatus::slips and ContactStatus::rubs.
struct FrictionStatus {
  NodeFlags slips;
  NodeFlags rubs;
};

/// Averages around nodes in contact that friction depends on, and the values of its law; empty without friction.
///
/// The slip s_a is that in the configuration at the start of the step, and F_a maps it to the present tangent plane.
struct NodalFriction {
  Matrix3Xd slip;                             ///< s_a [mm]
  Matrix3Xd area_vector;                      ///< INT psi_a n da / INT psi_a da
  VectorXd pressure;                          ///< p~ - p* [MPa]; empty if friction does not depend on it
  IndexedVector<Eigen::Matrix3d> convection;  ///< F_a
  Matrix3Xd trial;                            ///< tau_a [MPa]
  Matrix3Xd reference;                        ///< tau_a that an iteration began with; empty outside iterations
  VectorXd reference_bound;                   ///< T_max that an iteration began with
  Matrix3Xd geometric;  ///< lambda_T - eps_T s_a for the geometric part of the tangent; empty outside iterations
  VectorXd bound;       ///< T_max [MPa]
  Matrix3Xd traction;   ///< t_T [MPa]; 0 out of contact

  bool empty() const { return slip.size() == 0; }
  /// The trial that an iteration began with; outside iterations the present one.
  Vector3d reference_of(Index node) const { return (reference.size() > 0 ? reference : trial).col(node); }
  double reference_bound_of(Index node) const {
    return reference_bound.size() > 0 ? reference_bound[node] : bound[node];
  }
  /// n_a
  Vector3d normal(Index node) const { return area_vector.col(node).normalized(); }
};

/// The loads by the laws (2.7)-(2.9) at nodes of the primary surface, from averages around each node: g_a, jumps and
/// slips. The functions psi_a interpolate traction and fluxes between nodes.
///
/// The laws act at nodes instead of integration points, because a surface can meet as many conditions as it has nodes.
/// More conditions contradict each other on meshes that do not match, and some of their points open and close in turn.
struct NodalLoads : NodalGaps, ContactStatus {
  VectorXd traction;   ///< t_a [MPa]; 0 out of contact
  MatrixXd flux_area;  ///< (fields, nodes): INT psi_a da over points where both sides have the field [mm^2]
  MatrixXd jump;       ///< (fields, nodes)
  MatrixXd flux;       ///< (fields, nodes); 0 out of contact
  NodalFriction friction;
  /// (fields, nodes): the fields' values at the nodes themselves, which the jumps are averages around.
  MatrixXd own = {};  // NOLINT(readability-redundant-member-init): so that lists of initial values may leave it out

  const ContactStatus& status() const { return *this; }
  /// Whether a node exchanges a field with the other side.
  bool exchanges(Index field, Index node) const { return flux_coupled[node] && flux_area(field, node) > 0; }
};

/// The tractions and fluxes that act in `to` and not in `from`, at all nodes in contact in one of them: the part
/// of the change in the virtual work (2.5), which is linear in both.
NodalLoads change(const NodalLoads& from, const NodalLoads& to);

}  // namespace mixture_contact
