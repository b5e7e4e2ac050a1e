#include "geometry/kinematics.h"

#include "geometry/skew.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace mixture_contact {
namespace {

void set_gap(PointKinematics& point, const FacetCoordinates& x1, const FacetCoordinates& x2) {
  point.gap = (x2 * point.secondary_shape - x1 * point.primary_shape).dot(point.normal);
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
  set_gap(point, x1, x2);
  return point;
}

void move_on_flat_facets(PointKinematics& point, const FacetVector& primary, const FacetCoordinates& x1,
                         const FacetVector& secondary, const FacetCoordinates& x2) {
  point.primary_shape = primary;
  point.secondary_shape = secondary;
  set_gap(point, x1, x2);
}

PairVariation<3> area_vector_variation(const Eigen::Matrix<double, 3, 2>& tangents, const FacetGradient& gradient,
                                       Index nodes) {
  PairVariation<3> variation = PairVariation<3>::Zero(3, 3 * nodes);
  for (Index node = 0; node < gradient.rows(); ++node) {
    variation.middleCols<3>(3 * node) = gradient(node, 1) * skew(tangents.col(0)) -
                                        gradient(node, 0) * skew(tangents.col(1));
  }
  return variation;
}

Eigen::Matrix<double, 3, 2> area_vector_slope(const Eigen::Matrix<double, 3, 2>& tangents,
                                              const Eigen::Matrix3d& curvature) {
  const Vector3d first = tangents.col(0);
  const Vector3d second = tangents.col(1);
  Eigen::Matrix<double, 3, 2> slope;
  slope << curvature.col(0).cross(second) + first.cross(curvature.col(2)),
      curvature.col(2).cross(second) + first.cross(curvature.col(1));
  return slope;
}

KinematicVariations kinematic_variations(const PointKinematics& point, const PointMotion& motion) {
  const Index primary_nodes = point.primary_nodes();
  const Index columns = 3 * point.nodes();
  const PairVector h = point.jump_weights();
  const Vector3d& n = point.normal;
  // The condition 0 = d[(x2 - x1).x1,alpha] = (x2,beta.x1,alpha) deta_beta - h dx.x1,alpha + g n1.dx1,alpha gives deta.
  // In it dx1,alpha = N,alpha dx + x1,alpha beta dxi_beta, and a point that moves also adds x1,beta dxi_beta to the
  // change of x1. The gap varies by dg = n1.(-h dx + x2,beta deta_beta); the change of n1 has no part in it because x2
  // - x1 is along n1.
  PairVariation<2> slip(2, columns);
  KinematicVariations variations;
  variations.gap.resize(columns);
  variations.area_vector = area_vector_variation(point.primary_tangents, point.primary_gradient, point.nodes());
  variations.xi = motion.xi;
  variations.weight = motion.weight;
  for (Index node = 0; node < point.nodes(); ++node) {
    slip.middleCols<3>(3 * node) = h[node] * point.primary_tangents.transpose();
    variations.gap.segment<3>(3 * node) = -h[node] * n.transpose();
  }
  for (Index node = 0; node < primary_nodes; ++node) {
    const auto gradient = point.primary_gradient.row(node);
    slip.middleCols<3>(3 * node) -= point.gap * gradient.transpose() * n.transpose();
  }
  if (!motion.is_none()) {
    variations.area_vector += area_vector_slope(point.primary_tangents, motion.curvature).lazyProduct(motion.xi);
    const Eigen::RowVector3d bend = n.transpose() * motion.curvature;  // n1.x1,11, n1.x1,22, n1.x1,12
    Eigen::Matrix2d own = point.primary_tangents.transpose() * point.primary_tangents;
    own -= point.gap * (Eigen::Matrix2d() << bend[0], bend[2], bend[2], bend[1]).finished();
    slip += own.lazyProduct(motion.xi);
  }
  const Eigen::Matrix2d metric = point.primary_tangents.transpose() * point.secondary_tangents;
  variations.eta = metric.inverse().lazyProduct(slip);
  variations.gap += (n.transpose() * point.secondary_tangents).lazyProduct(variations.eta);
  variations.area = n.transpose().lazyProduct(variations.area_vector);
  return variations;
}

}  // namespace mixture_contact
