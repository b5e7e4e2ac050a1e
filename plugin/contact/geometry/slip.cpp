#include "geometry/slip.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace mixture_contact {
namespace {

Vector3d interpolated(const FacetCoordinates& x, const FacetVector& shape) {
  Vector3d sum = Vector3d::Zero();
  for (Index node = 0; node < shape.size(); ++node) sum += shape[node] * x.col(node);
  return sum;
}

Eigen::Matrix<double, 3, 2> tangents(const FacetCoordinates& x, const FacetGradient& gradient) {
  Eigen::Matrix<double, 3, 2> sum = Eigen::Matrix<double, 3, 2>::Zero();
  for (Index node = 0; node < gradient.rows(); ++node) sum += x.col(node).lazyProduct(gradient.row(node));
  return sum;
}

Vector3d area_vector(const Eigen::Matrix<double, 3, 2>& tangents) { return tangents.col(0).cross(tangents.col(1)); }

Vector3d distance(const PointKinematics& point, const FacetCoordinates& past1, const FacetCoordinates& past2) {
  return interpolated(past2, point.secondary_shape) - interpolated(past1, point.primary_shape);
}

Vector3d in_plane(const Vector3d& vector, const Vector3d& normal) { return vector - normal * normal.dot(vector); }

}  // namespace

PastPoint past_point(const PointKinematics& point, const FacetCoordinates& past1, const FacetCoordinates& past2) {
  PastPoint past;
  past.distance = distance(point, past1, past2);
  past.primary_tangents = tangents(past1, point.primary_gradient);
  past.secondary_tangents = tangents(past2, point.secondary_gradient);
  past.normal = area_vector(past.primary_tangents).normalized();
  return past;
}

Vector3d slip(const PastPoint& past) { return in_plane(past.distance, past.normal); }

Vector3d slip(const PointKinematics& point, const FacetCoordinates& past1, const FacetCoordinates& past2) {
  const Vector3d normal = area_vector(tangents(past1, point.primary_gradient)).normalized();
  return in_plane(distance(point, past1, past2), normal);
}

Eigen::Matrix<double, 3, 2> normal_slope(const PastPoint& past, const Eigen::Matrix3d& curvature) {
  const Eigen::Matrix<double, 3, 2> slope = area_vector_slope(past.primary_tangents, curvature);
  return (slope - past.normal * (past.normal.transpose() * slope)) / area_vector(past.primary_tangents).norm();
}

Eigen::Matrix<double, 3, 2> slip_slope_with_eta(const PastPoint& past) {
  return past.secondary_tangents - past.normal * (past.normal.transpose() * past.secondary_tangents);
}

Eigen::Matrix<double, 3, 2> slip_slope_with_xi(const PastPoint& past, const Eigen::Matrix<double, 3, 2>& normal_slope) {
  const Vector3d& n = past.normal;
  return -past.primary_tangents - normal_slope * n.dot(past.distance) - n * (past.distance.transpose() * normal_slope);
}

Convection convection(const Facet& facet, Index corner, const FacetCoordinates& past) {
  const FacetGradient& gradient = gradient_at_node(facet.type, indexing::as_int(corner));
  const Eigen::Matrix<double, 3, 2> t = tangents(past, gradient);
  const double area = area_vector(t).norm();
  const Eigen::Matrix2d metric = t.transpose() * t;
  if (!(metric.determinant() > 0)) return {FacetCoordinates::Zero(3, past.cols()), area};
  return {(t * metric.inverse()).lazyProduct(gradient.transpose()), area};
}

}  // namespace mixture_contact
