#include "kinematics.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace mixture_contact {
namespace {

/// Matrix of the cross product: skew(v) w = v x w.
Eigen::Matrix3d skew(const Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return matrix;
}

}  // namespace

PairVector PointKinematics::jump_weights() const {
  PairVector weights(nodes());
  weights << primary_shape, -secondary_shape;
  return weights;
}

PointKinematics point_kinematics(const ShapeFunctions& primary, const FacetCoordinates& x1,
                                 const ShapeFunctions& secondary, const FacetCoordinates& x2) {
  PointKinematics point;
  point.primary_shape = primary.value;
  point.primary_gradient = primary.gradient;
  point.secondary_shape = secondary.value;
  point.secondary_gradient = secondary.gradient;
  point.primary_tangents = x1 * primary.gradient;
  point.secondary_tangents = x2 * secondary.gradient;
  point.area_vector = point.primary_tangents.col(0).cross(point.primary_tangents.col(1));
  point.area = point.area_vector.norm();
  point.normal = point.area_vector / point.area;
  point.gap = (x2 * secondary.value - x1 * primary.value).dot(point.normal);
  return point;
}

KinematicVariations kinematic_variations(const PointKinematics& point) {
  const Index primary_nodes = point.primary_nodes();
  const Index columns = 3 * point.nodes();
  const PairVector h = point.jump_weights();
  const Vector3d& n = point.normal;
  // 0 = d[(x2 - x1).x1,alpha] = (x2,beta.x1,alpha) deta_beta - h dx.x1,alpha + g n1.dx1,alpha  gives deta,
  // dg = n1.(-h dx + x2,beta deta_beta); the change of n1 does not enter since x2 - x1 is along n1.
  PairVariation<2> slip(2, columns);
  KinematicVariations variations;
  variations.gap.resize(columns);
  variations.area_vector.setZero(3, columns);
  for (Index node = 0; node < point.nodes(); ++node) {
    slip.middleCols<3>(3 * node) = h[node] * point.primary_tangents.transpose();
    variations.gap.segment<3>(3 * node) = -h[node] * n.transpose();
  }
  for (Index node = 0; node < primary_nodes; ++node) {
    const auto gradient = point.primary_gradient.row(node);
    slip.middleCols<3>(3 * node) -= point.gap * gradient.transpose() * n.transpose();
    variations.area_vector.middleCols<3>(3 * node) = gradient[1] * skew(point.primary_tangents.col(0)) -
                                                     gradient[0] * skew(point.primary_tangents.col(1));
  }
  const Eigen::Matrix2d metric = point.primary_tangents.transpose() * point.secondary_tangents;
  variations.eta = metric.inverse() * slip;
  variations.gap += (n.transpose() * point.secondary_tangents) * variations.eta;
  variations.area = n.transpose() * variations.area_vector;
  return variations;
}

}  // namespace mixture_contact
