/// The heart of the contact: residual and tangent of the virtual work (2.5) at one integration point. Pure functions.
#pragma once

#include "base/local_layout.h"
#include "geometry/kinematics.h"
#include "law/laws.h"

namespace mixture_contact {

/// Nodal values of the exchanged scalar fields on a pair of facets, one column per field, shape (n1 + n2, fields).
using PairFields = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_pair_nodes>;

/// What acts at an integration point.
struct PointLoads {
  LawValue traction{0.0, 0.0};        ///< t_n [MPa] and dt_n/dg
  Vector2d traction_slope{0.0, 0.0};  ///< dt_n/dxi_alpha where the point moves over the primary facet
  Eigen::Array<LawValue, Eigen::Dynamic, 1>
      flux;                     ///< per exchanged field: q_n and dq_n/djump; zero where not exchanged
  Eigen::MatrixX2d flux_slope;  ///< dq_n/dxi_alpha per exchanged field; empty where the point does not move
  Vector3d friction{0, 0, 0};   ///< t_T [MPa]
  Eigen::Matrix<double, 3, 2> friction_slope = Eigen::Matrix<double, 3, 2>::Zero();  ///< dt_T/dxi_alpha
  double weight = 0;          ///< quadrature weight: da1 = weight * |a|
  double time_increment = 0;  ///< fluxes are integrated over the time step: their rows carry dt [s]

  bool has_friction() const { return !friction.isZero(0) || !friction_slope.isZero(0); }
};

/// Contribution to the virtual work (2.5), dG = residual . (virtual positions and fields), shape (layout.size()).
///
/// Displacement rows: w t_n h_a a  [N]; row of field k: w dt |a| q_k h_a  [mm^3 or nmol], with h = (N1, -N2).
VectorXd point_residual(const PointKinematics& point, const PointLoads& loads, const LocalLayout& layout);

/// Exact derivative of the displacement rows of point_residual and of add_friction() with the nodal positions, eq
/// (2.6), including the changes of da1, of n1, of the projected position and of the tractions there, t_T of the nodes
/// held; rows and columns in the order of `layout`, which has no fields.
MatrixXd traction_tangent(const PointKinematics& point, const KinematicVariations& vary, const PointLoads& loads,
                          const LocalLayout& layout);

/// The part of friction: displacement rows w |a| h_a t_T. It acts at the two points that face each other, as the normal
/// traction does: equal and opposite.
void add_friction(const PointKinematics& point, const PointLoads& loads, const LocalLayout& layout, VectorXd& residual);

/// Exact derivative of the rows of field k of point_residual, one per node, with the nodal positions and that field's
/// nodal values; columns in the order of `layout`, which has one field.
MatrixXd flux_tangent(const PointKinematics& point, const KinematicVariations& vary, const PointLoads& loads, Index k,
                      const PairVector& values, const LocalLayout& layout);

/// Share of a point in an average, w psi_a, with its variation.
struct PointShare {
  double value;
  PairVariation<1> variation;
};

/// First variation of the contributions w psi_a |a| g to an average of the gap and w psi_a |a| to its area, with the
/// positions of the pair.
struct WeightedVariation {
  PairVariation<1> integral;  ///< d(w psi_a |a| value), three columns per node
  PairVariation<1> area;      ///< d(w psi_a |a|)
};
WeightedVariation gap_variation(const PointKinematics& point, const KinematicVariations& vary, const PointShare& share);

/// The same for the jump of a field with the given nodal values; its variation with those values is w psi_a |a| h.
WeightedVariation jump_variation(const PointKinematics& point, const KinematicVariations& vary, const PointShare& share,
                                 const PairVector& values);

}  // namespace mixture_contact
