/// Kinematics of sliding: how far the two material points that face each other now were apart, along the surface, when
/// the time step began.
#pragma once

#include "geometry/kinematics.h"

namespace mixture_contact {

/// Two points that face each other now, where they were when the time step began: X1(xi) and X2(eta).
struct PastPoint {
  Vector3d distance;                               ///< D = X2 - X1
  Vector3d normal;                                 ///< N1 at xi
  Eigen::Matrix<double, 3, 2> primary_tangents;    ///< X1,alpha
  Eigen::Matrix<double, 3, 2> secondary_tangents;  ///< X2,beta
};

/// The point at the start of the time step: its present shape functions with the nodal positions of both facets at that
/// time, `past1` and `past2` [mm].
PastPoint past_point(const PointKinematics& point, const FacetCoordinates& past1, const FacetCoordinates& past2);

/// Slip over the step of the primary side relative to the secondary one, r = (1 - N N) D, in the configuration at the
/// start of the step. It is zero in any rigid motion of both bodies, whatever the gap: then D = g N.
Vector3d slip(const PastPoint& past);
/// Slip over the step of the primary side relative to the secondary one [mm], by the nodal positions when the step
/// began. It does without the tangents of the past point, which only the slope of the slip needs.
Vector3d slip(const PointKinematics& point, const FacetCoordinates& past1, const FacetCoordinates& past2);

/// Derivative of the unit normal with xi. `curvature`: columns X1,11, X1,22, X1,12.
Eigen::Matrix<double, 3, 2> normal_slope(const PastPoint& past, const Eigen::Matrix3d& curvature);

/// How the slip varies with the present nodal positions, as other points face each other: dr = r,eta deta + r,xi dxi
/// = (1 - N N) (X2,beta deta_beta - X1,alpha dxi_alpha) - (dN N + N dN) D with dN = N,alpha dxi_alpha.
Eigen::Matrix<double, 3, 2> slip_slope_with_eta(const PastPoint& past);
Eigen::Matrix<double, 3, 2> slip_slope_with_xi(const PastPoint& past, const Eigen::Matrix<double, 3, 2>& normal_slope);

/// How the surface around a node of a facet has moved since the step began, F = x,alpha (X) X^alpha.
struct Convection {
  FacetCoordinates coefficients;  ///< C_b, one column per node: F = sum_b x_b C_b^T, linear in present positions x_b
  double area;                    ///< |X,1 x X,2| at the node
};

/// F maps a vector of the past tangent plane to the present: it turns and stretches with the surface, and drops a
/// normal part. Zero if the facet has no area there.
Convection convection(const Facet& facet, Index corner, const FacetCoordinates& past);

}  // namespace mixture_contact
