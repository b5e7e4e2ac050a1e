#include "geometry/projection.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <limits>

namespace mixture_contact {
namespace {

/// Newton from one start; empty where it does not converge.
///
/// Convergence is quadratic, so the step that falls below sqrt(epsilon) of the facet's size leaves an error of epsilon:
/// one more step is taken and accepted. On a plane triangle the equations are linear, and the first step is.
std::optional<RayHit> newton(FacetType type, const FacetCoordinates& x, const Vector3d& origin,
                             const Vector3d& direction, const Vector2d& start) {
  constexpr int max_steps = 25;
  const double accept = std::sqrt(std::numeric_limits<double>::epsilon());
  Vector3d unknown(start[0], start[1], 0);
  bool close = type == FacetType::tri3;
  for (int step = 0; step < max_steps; ++step) {
    const ShapeFunctions shape = shape_functions(type, unknown.head<2>());
    const Vector3d miss = x * shape.value - origin - unknown[2] * direction;
    Eigen::Matrix3d slope;
    slope << x * shape.gradient, -direction;
    const Vector3d change = slope.inverse() * miss;
    unknown -= change;
    if (!unknown.allFinite()) return std::nullopt;
    if (close) return RayHit{unknown.head<2>(), unknown[2]};
    close = change.head<2>().norm() < accept;
  }
  return std::nullopt;
}

/// Whether the facet's normals at all nodes are on one side of a direction. A line along it then meets the facet at
/// most once: to meet it twice it has to enter and to leave. (Exact for quad4, whose normal is linear between its
/// corners.)
bool faces_one_way(FacetType type, const FacetCoordinates& x, const Vector3d& direction) {
  bool towards = false;
  bool away = false;
  for (int a = 0; a < node_count(type); ++a) {
    const Eigen::Matrix<double, 3, 2> tangents = x * shape_functions(type, parametric_node(type, a)).gradient;
    const double side = tangents.col(0).cross(tangents.col(1)).dot(direction);
    towards = towards || side > 0;
    away = away || side < 0;
  }
  return !(towards && away);
}

}  // namespace

std::optional<RayHit> intersect(FacetType type, const FacetCoordinates& x, const Vector3d& origin,
                                const Vector3d& direction, double tolerance) {
  std::optional<RayHit> best;
  const auto converges_from = [&](const Vector2d& start) {
    const std::optional<RayHit> hit = newton(type, x, origin, direction, start);
    if (hit && distance_outside(type, hit->eta) <= tolerance && (!best || std::abs(hit->gap) < std::abs(best->gap)))
      best = hit;
    return hit.has_value();
  };
  const bool converged = converges_from(parametric_centre(type));
  if (type == FacetType::tri3 && converged) return best;
  if ((best || (converged && edge_degree(type) == 1)) && faces_one_way(type, x, direction)) return best;
  for (int a = 0; a < node_count(type); ++a) converges_from(parametric_node(type, a));
  return best;
}

}  // namespace mixture_contact
