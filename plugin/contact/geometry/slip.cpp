#include "geometry/slip.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace mixture_contact {
namespace {

FacetGradient gradient_at_node(const Facet& facet, Index corner) {
  return shape_functions(facet.type, parametric_node(facet.type, static_cast<int>(corner))).gradient;
}

Vector3d area_vector(const Eigen::Matrix<double, 3, 2>& tangents) { return tangents.col(0).cross(tangents.col(1)); }

}  // namespace

PastPoint past_point(const PointKinematics& point, const FacetCoordinates& past1, const FacetCoordinates& past2) {
  PastPoint past;
  past.distance = past2 * point.secondary_shape - past1 * point.primary_shape;
  past.primary_tangents = past1 * point.primary_gradient;
  past.secondary_tangents = past2 * point.secondary_gradient;
  past.normal = area_vector(past.primary_tangents).normalized();
  return past;
}

Vector3d slip(const PastPoint& past) { return past.distance - past.normal * past.normal.dot(past.distance); }

Eigen::Matrix<double, 3, 2> normal_slope(const PastPoint& past, const Eigen::Matrix3d& curvature) {
  const Eigen::Matrix<double, 3, 2> slope = area_vector_slope(past.primary_tangents, curvature);
  return (slope - past.normal * (past.normal.transpose() * slope)) / area_vector(past.primary_tangents).norm();
}

PairVariation<3> slip_variation(const PastPoint& past, const Eigen::Matrix<double, 3, 2>& normal_slope,
                                const KinematicVariations& vary) {
  const Vector3d& n = past.normal;
  const Eigen::Matrix<double, 3, 2> with_eta = past.secondary_tangents - n * (n.transpose() * past.secondary_tangents);
  const Eigen::Matrix<double, 3, 2> with_xi = past.primary_tangents + normal_slope * n.dot(past.distance) +
                                              n * (past.distance.transpose() * normal_slope);
  return with_eta * vary.eta - with_xi * vary.xi;
}

FacetCoordinates convection(const Facet& facet, Index corner, const FacetCoordinates& past) {
  const FacetGradient gradient = gradient_at_node(facet, corner);
  const Eigen::Matrix<double, 3, 2> tangents = past * gradient;
  const Eigen::Matrix2d metric = tangents.transpose() * tangents;
  if (!(metric.determinant() > 0)) return FacetCoordinates::Zero(3, past.cols());
  return tangents * metric.inverse() * gradient.transpose();
}

double area_at_node(const Facet& facet, Index corner, const FacetCoordinates& x) {
  return area_vector(x * gradient_at_node(facet, corner)).norm();
}

}  // namespace mixture_contact
