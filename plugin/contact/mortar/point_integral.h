/// Residual and tangent of the virtual work (2.5) at one integration point, as pure functions.
#pragma once

#include "base/local_layout.h"
#include "geometry/kinematics.h"

namespace mixture_contact {

/// Nodal values of the exchanged scalar fields on a pair of facets, one column per field, shape (n1 + n2, fields).
using PairFields = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_pair_nodes>;

/// The loads at an integration point, interpolated from the nodes of its primary facet.
struct PointLoads {
  double traction = 0;                ///< normal traction t_n [MPa]
  Vector2d traction_slope{0.0, 0.0};  ///< derivatives dt_n/dxi_alpha; used if the point moves on the primary facet
  VectorXd flux;                      ///< flux q_n per exchanged field
  Eigen::MatrixX2d flux_slope;  ///< derivatives dq_n/dxi_alpha per exchanged field; empty if the point does not move
  Vector3d friction{0, 0, 0};   ///< friction traction t_T [MPa]
  /// Derivatives dt_T/dxi_alpha; used if the point moves on the primary facet.
  Eigen::Matrix<double, 3, 2> friction_slope = Eigen::Matrix<double, 3, 2>::Zero();
  double weight = 0;          ///< quadrature weight: da1 = weight * |a|
  double time_increment = 0;  ///< time increment dt [s]: the rows of fluxes are integrated over the step
};

/// Adds the contribution of a point to the virtual work (2.5), dG = residual . (virtual positions and fields), shape
/// (layout.size()).
///
/// Displacement rows: w h_a (t_n a + |a| t_T) [N]. Normal traction and friction both act at the two points that face
/// each other. Rows of field k: w dt |a| q_k h_a [mm^3 or nmol], with h = (N1, -N2).
void add_residual(const PointKinematics& point, const PointLoads& loads, const LocalLayout& layout, VectorXd& residual);

/// The force at a point on the primary side [N] and its variation with the positions of the first nodes of the pair; it
/// does not depend on nodes without columns.
struct PointForce {
  Vector3d value;
  PairVariation<3> variation;
};
/// The force of the normal traction, w t_n a.
PointForce normal_force(const PointKinematics& point, const KinematicVariations& vary, const PointLoads& loads);
/// Adds the force of friction, w |a| t_T.
void add_friction_force(const PointKinematics& point, const KinematicVariations& vary, const PointLoads& loads,
                        PointForce& force);

/// Adds the exact derivative of the displacement rows of add_residual() with respect to the nodal positions, eq (2.6),
/// at constant loads of the nodes. It includes the changes of da1, of n1, of the projected position and of the
/// interpolated tractions. Rows and columns contain displacements only. `force`: of all tractions.
void add_traction_tangent(const PointKinematics& point, const KinematicVariations& vary, const PointForce& force,
                          MatrixXd& tangent);

/// Adds the exact derivative of the residual rows of field k, one per node, with the nodal positions, at constant loads
/// of the nodes. The columns have the order of `layout`.
void add_flux_tangent(const PointKinematics& point, const KinematicVariations& vary, const PointLoads& loads, Index k,
                      const LocalLayout& layout, MatrixXd& tangent);

/// Derivative of the jump h.phi of nodal values phi with the nodal positions: phi1,alpha dxi_alpha - phi2,beta
/// deta_beta.
PairVariation<1> jump_variation(const PointKinematics& point, const KinematicVariations& vary,
                                const PairVector& values);

}  // namespace mixture_contact
