/// Slip at an integration point: the tangential displacement over the time step of the primary point relative to the
/// secondary point that it faces now.
#pragma once

#include "geometry/kinematics.h"

namespace mixture_contact {

/// The positions X1(xi) and X2(eta) at the start of the time step of two points that face each other now.
struct PastPoint {
  Vector3d distance;                               ///< distance D = X2 - X1 of the points
  Vector3d normal;                                 ///< N1, unit normal of the primary facet at xi
  Eigen::Matrix<double, 3, 2> primary_tangents;    ///< tangents X1,alpha
  Eigen::Matrix<double, 3, 2> secondary_tangents;  ///< tangents X2,beta
};

/// The positions at the start of the time step. `point`: the present kinematics, of which the shape functions are used.
/// `past1`, `past2`: positions of the facets' nodes at the start of the step [mm].
PastPoint past_point(const PointKinematics& point, const FacetCoordinates& past1, const FacetCoordinates& past2);

/// Slip of the primary side relative to the secondary side over the step [mm], r = (1 - N N) D, in the configuration at
/// the start of the step. It is zero in any rigid motion of both bodies with any gap, because D = g N then.
Vector3d slip(const PastPoint& past);
/// Slip of the primary side relative to the secondary side over the step [mm], from the nodal positions at the start of
/// the step. It computes no tangents at the start of the step, which only the derivatives of the slip need.
Vector3d slip(const PointKinematics& point, const FacetCoordinates& past1, const FacetCoordinates& past2);

/// Derivative of the unit normal N1 with respect to xi. `curvature`: columns X1,11, X1,22, X1,12.
Eigen::Matrix<double, 3, 2> normal_slope(const PastPoint& past, const Eigen::Matrix3d& curvature);

/// Derivatives r,eta of the slip with the position eta of the secondary point.
///
/// The slip varies with the present nodal positions because other points then face each other: dr = r,eta deta + r,xi
/// dxi = (1 - N N) (X2,beta deta_beta - X1,alpha dxi_alpha) - (dN N + N dN) D, with dN = N,alpha dxi_alpha.
Eigen::Matrix<double, 3, 2> slip_slope_with_eta(const PastPoint& past);
/// Derivatives r,xi of the slip with the position xi of the primary point, in the same equation. `normal_slope`:
/// N,alpha.
Eigen::Matrix<double, 3, 2> slip_slope_with_xi(const PastPoint& past, const Eigen::Matrix<double, 3, 2>& normal_slope);

/// Deformation gradient of the surface over the step at a node of a facet, F = x,alpha (X) X^alpha. F maps a vector in
/// the tangent plane at the start of the step to the present tangent plane: the vector rotates and stretches with the
/// surface, and its normal component is dropped.
struct Convection {
  FacetCoordinates coefficients;  ///< C_b, one column per node: F = sum_b x_b C_b^T, linear in present positions x_b
  double area;                    ///< area element |X,1 x X,2| at the node
};

/// The deformation gradient at a corner of a facet. `past`: nodal positions at the start of the step [mm]. Zero if the
/// facet has no area at the corner.
Convection convection(const Facet& facet, Index corner, const FacetCoordinates& past);

}  // namespace mixture_contact
