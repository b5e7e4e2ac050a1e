#include "geometry/flat_pair.h"

#include "geometry/skew.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace mixture_contact {
namespace {

/// Tangents x,1 and x,2 of a triangle.
Eigen::Matrix<double, 3, 2> tangents(const TriangleCoordinates& x) {
  Eigen::Matrix<double, 3, 2> tangents;
  tangents << x.col(1) - x.col(0), x.col(2) - x.col(0);
  return tangents;
}

/// The weights h = (sum w psi N1, -sum w psi N2) times a vector, one vector per node.
FlatVariation by_nodes(const Vector3d& primary, const Vector3d& secondary, const Vector3d& vector) {
  FlatVariation result;
  for (Index b = 0; b < 3; ++b) {
    result.segment<3>(3 * b) = primary[b] * vector;
    result.segment<3>(9 + 3 * b) = -secondary[b] * vector;
  }
  return result;
}

/// The part of a pair in the variation of the average of a quantity y over node c. The pair adds sum w psi_c |a| y to
/// the average, with dy = `along`.deta + `by_shape` h.dx. `excess`: sum w psi_c (y - average).
FlatVariation mean_variation(const FlatPair& pair, const FlatVariations& vary, Index c, const Vector2d& along,
                             const Vector3d& by_shape, double excess, double nodal_area) {
  const double share = pair.area / nodal_area;
  const Vector3d by_gap = share * pair.gap[c] * (vary.tilted * along);
  FlatVariation variation = by_nodes(pair.moments.primary.row(c), pair.moments.secondary.row(c),
                                     share * (vary.eta * along + by_shape));
  for (Index b = 0; b < 3; ++b)
    variation.segment<3>(3 * b) += excess / nodal_area * vary.area.col(b) - by_gap[b] * pair.normal;
  return variation;
}

FlatSums flat_sums(const FlatPair& pair, const FlatVariations& vary, const Vector3d& loads) {
  return {pair.moments.primary.transpose() * loads, pair.moments.secondary.transpose() * loads, pair.normal,
          vary.eta * area_gradient().transpose(), loads.dot(pair.gap) * area_gradient() * vary.tilted.transpose()};
}

}  // namespace

void FlatMoments::add(double weight, const Vector2d& xi, const Vector2d& eta) {
  const Vector3d one = area_coordinates(xi);
  const Vector3d share = weight * one;
  primary += share * one.transpose();
  secondary += share * area_coordinates(eta).transpose();
}

FlatPair flat_pair(const FlatMoments& moments, const TriangleCoordinates& x1, const TriangleCoordinates& x2) {
  FlatPair pair{moments};
  const Eigen::Matrix<double, 3, 2> along = tangents(x1);
  pair.area_vector = along.col(0).cross(along.col(1));
  pair.area = pair.area_vector.norm();
  pair.normal = pair.area_vector / pair.area;
  pair.gap = moments.secondary * (x2.transpose() * pair.normal) - moments.primary * (x1.transpose() * pair.normal);
  return pair;
}

FlatNodes FlatPair::jump_weights(Index c) const {
  FlatNodes weights;
  weights << moments.primary.row(c).transpose(), -moments.secondary.row(c).transpose();
  return weights;
}

Vector3d FlatPair::jump(const FlatNodes& values) const {
  return moments.primary * values.head<3>() - moments.secondary * values.tail<3>();
}

FlatVariations flat_variations(const FlatPair& pair, const TriangleCoordinates& x1, const TriangleCoordinates& x2) {
  const Eigen::Matrix<double, 3, 2> one = tangents(x1);
  const Eigen::Matrix<double, 3, 2> two = tangents(x2);
  const Eigen::Matrix2d inverse = (one.transpose() * two).inverse().transpose();
  FlatVariations vary;
  for (Index b = 0; b < 3; ++b) {
    const Vector3d w = area_gradient()(b, 1) * one.col(0) - area_gradient()(b, 0) * one.col(1);
    vary.area_vector.col(b) = w;
    vary.area.col(b) = pair.normal.cross(w);
  }
  vary.eta = one * inverse;
  vary.tilted = area_gradient() * inverse;
  vary.slope = two.transpose() * pair.normal;
  return vary;
}

FlatVariation traction_work(const FlatPair& pair, Index c) {
  return by_nodes(pair.moments.primary.row(c), pair.moments.secondary.row(c), pair.area_vector);
}

FlatVariation mean_gap_variation(const FlatPair& pair, const FlatVariations& vary, Index c, double mean,
                                 double nodal_area) {
  // dg = n1.(-h dx + x2,beta deta_beta)
  const double excess = pair.gap[c] - mean * pair.moments.primary.row(c).sum();
  return mean_variation(pair, vary, c, vary.slope, -pair.normal, excess, nodal_area);
}

FlatVariation mean_jump_variation(const FlatPair& pair, const FlatVariations& vary, Index c, const FlatNodes& values,
                                  double mean, double nodal_area) {
  // djump = -N2,beta.values deta_beta
  const double excess = pair.jump_weights(c).dot(values) - mean * pair.moments.primary.row(c).sum();
  const Vector2d along = -area_gradient().transpose() * values.tail<3>();
  return mean_variation(pair, vary, c, along, Vector3d::Zero(), excess, nodal_area);
}

FlatVariation traction_residual(const FlatPair& pair, const Vector3d& traction) {
  return by_nodes(pair.moments.primary.transpose() * traction, pair.moments.secondary.transpose() * traction,
                  pair.area_vector);
}

FlatNodes flux_residual(const FlatPair& pair, const Vector3d& flux) {
  FlatNodes flows;
  flows << pair.moments.primary.transpose() * flux, -pair.moments.secondary.transpose() * flux;
  return pair.area * flows;
}

FlatFlows flat_flows(const FlatPair& pair, const FlatVariations& vary, const Vector3d& flux) {
  return {flat_sums(pair, vary, flux), pair.area, vary.area};
}

Eigen::Matrix<double, 1, 9> primary_rows(const FlatFlows& flows, Index node) {
  return flows.fluxes.primary[node] * flows.with_area.reshaped().transpose();
}

Eigen::Matrix<double, 1, 18> secondary_rows(const FlatFlows& flows, Index node) {
  const FlatSums& sums = flows.fluxes;
  Eigen::Matrix<double, 1, 18> rows;
  for (Index c = 0; c < 3; ++c) {
    rows.segment<3>(3 * c) = -sums.secondary[node] * flows.with_area.col(c) - flows.area * sums.with_primary(node, c);
    rows.segment<3>(9 + 3 * c) = -flows.area * sums.with_secondary(node, c);
  }
  return rows;
}

Eigen::Matrix<double, 6, 18> flux_tangent(const FlatFlows& flows) {
  Eigen::Matrix<double, 6, 18> tangent = Eigen::Matrix<double, 6, 18>::Zero();
  for (Index node = 0; node < 3; ++node) {
    tangent.block<1, 9>(node, 0) = primary_rows(flows, node);
    tangent.row(3 + node) = secondary_rows(flows, node);
  }
  return tangent;
}

FlatForces flat_forces(const FlatPair& pair, const FlatVariations& vary, const Vector3d& traction) {
  return {flat_sums(pair, vary, traction), pair.area_vector, vary.area_vector};
}

Eigen::Matrix<double, 3, 9> primary_rows(const FlatForces& forces, Index node) {
  Eigen::Matrix<double, 3, 9> rows;
  for (Index c = 0; c < 3; ++c)
    rows.middleCols<3>(3 * c) = skew(forces.tractions.primary[node] * forces.with_normal.col(c));
  return rows;
}

Eigen::Matrix<double, 3, 18> secondary_rows(const FlatForces& forces, Index node) {
  const FlatSums& sums = forces.tractions;
  Eigen::Matrix<double, 3, 18> rows;
  for (Index c = 0; c < 3; ++c) {
    rows.middleCols<3>(3 * c) = -skew(sums.secondary[node] * forces.with_normal.col(c)) -
                                forces.area_vector * sums.with_primary(node, c).transpose();
    rows.middleCols<3>(9 + 3 * c) = -forces.area_vector * sums.with_secondary(node, c).transpose();
  }
  return rows;
}

FlatTangent traction_tangent(const FlatForces& forces) {
  FlatTangent tangent = FlatTangent::Zero();
  for (Index node = 0; node < 3; ++node) {
    tangent.block<3, 9>(3 * node, 0) = primary_rows(forces, node);
    tangent.middleRows<3>(9 + 3 * node) = secondary_rows(forces, node);
  }
  return tangent;
}

}  // namespace mixture_contact
