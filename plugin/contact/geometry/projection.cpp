#include "geometry/projection.h"

#include "geometry/circle.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <limits>

namespace mixture_contact {
namespace {

/// Newton's method from one start; empty if it does not converge.
///
/// Convergence is quadratic: after a step below sqrt(epsilon) of the facet's size, one more step leaves an error of
/// about epsilon and is accepted.
std::optional<RayHit> newton(FacetType type, const FacetCoordinates& x, const Vector3d& origin,
                             const Vector3d& direction, const Vector2d& start) {
  constexpr int max_steps = 25;
  const double accept = std::sqrt(std::numeric_limits<double>::epsilon());
  Vector3d unknown(start[0], start[1], 0);
  bool close = false;
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

/// Intersection of a line with the plane of a triangle, by Cramer's rule (Moller and Trumbore 1997, J Graph Tools
/// 2(1):21); empty if they are parallel.
std::optional<RayHit> on_plane(const FacetCoordinates& x, const Vector3d& origin, const Vector3d& direction) {
  const Vector3d first = x.col(1) - x.col(0);
  const Vector3d second = x.col(2) - x.col(0);
  const Vector3d from = origin - x.col(0);
  const Vector3d p = direction.cross(second);
  const Vector3d q = from.cross(first);
  const Vector3d unknown = Vector3d(from.dot(p), direction.dot(q), second.dot(q)) / first.dot(p);
  if (!unknown.allFinite()) return std::nullopt;
  return RayHit{unknown.head<2>(), unknown[2]};
}

/// Control points of a facet as a Bezier surface, x = SUM B_i(eta) b_i with SUM B_i = 1, and the upper bound of SUM
/// |B_i| for points at most `tolerance` outside the facet. The facet is within the convex hull of the control points;
/// the bound limits how far its extension leaves the hull.
struct ControlNet {
  FacetCoordinates points;
  double most;
};

/// The control points of a quad4 or a tri6; empty for other facet types.
std::optional<ControlNet> control_net(FacetType type, const FacetCoordinates& x, double tolerance) {
  if (type == FacetType::quad4) {
    // B = (1 +- eta_1)(1 +- eta_2)/4, and |1 + eta| + |1 - eta| <= 2 (1 + tolerance)
    return ControlNet{x, (1 + tolerance) * (1 + tolerance)};
  }
  if (type != FacetType::tri6) return std::nullopt;
  // B = l_a l_a and 2 l_a l_b with l_0 + l_1 + l_2 = 1 and l_a >= -tolerance, where at most two l_a are negative: SUM
  // |B| is the square of SUM |l_a| <= 1 + 4 tolerance. A mid-edge node is at (b_a + 2 b_ab + b_b)/4.
  ControlNet net{x, (1 + 4 * tolerance) * (1 + 4 * tolerance)};
  for (Index a = 0; a < 3; ++a) net.points.col(3 + a) = 2 * x.col(3 + a) - 0.5 * (x.col(a) + x.col((a + 1) % 3));
  return net;
}

/// True if a line is so far from a facet that it cannot meet it.
bool passes_by(FacetType type, const FacetCoordinates& x, const Vector3d& origin, const Vector3d& direction,
               double tolerance) {
  const std::optional<ControlNet> net = control_net(type, x, tolerance);
  if (!net) return false;
  const Vector3d centre = net->points.rowwise().mean();
  return is_passed({centre, net->most * radius_around(net->points, centre)}, origin, direction);
}

/// True if the facet's normals at all nodes are on one side of a direction. A line along this direction then meets the
/// facet at most once, because it would have to enter and to leave for a second intersection. (Exact for quad4, whose
/// area vector is linear in its parametric coordinates.)
bool faces_one_way(FacetType type, const FacetCoordinates& x, const Vector3d& direction) {
  bool towards = false;
  bool away = false;
  for (int a = 0; a < node_count(type); ++a) {
    const Eigen::Matrix<double, 3, 2> tangents = x * gradient_at_node(type, a);
    const double side = tangents.col(0).cross(tangents.col(1)).dot(direction);
    towards = towards || side > 0;
    away = away || side < 0;
  }
  return !(towards && away);
}

bool is_nearer(const RayHit& hit, const std::optional<RayHit>& best) {
  return !best || std::abs(hit.gap) < std::abs(best->gap);
}

}  // namespace

std::optional<RayHit> intersect(FacetType type, const FacetCoordinates& x, const Vector3d& origin,
                                const Vector3d& direction, double tolerance) {
  const auto is_within = [&](const std::optional<RayHit>& hit) {
    return hit && distance_outside(type, hit->eta) <= tolerance;
  };
  if (type == FacetType::tri3) {
    const std::optional<RayHit> hit = on_plane(x, origin, direction);
    return is_within(hit) ? hit : std::nullopt;
  }
  if (passes_by(type, x, origin, direction, tolerance)) return std::nullopt;
  std::optional<RayHit> best;
  const auto converges_from = [&](const Vector2d& start) {
    const std::optional<RayHit> hit = newton(type, x, origin, direction, start);
    if (is_within(hit) && is_nearer(*hit, best)) best = hit;
    return hit.has_value();
  };
  const bool converged = converges_from(parametric_centre(type));
  if ((best || (converged && edge_degree(type) == 1)) && faces_one_way(type, x, direction)) return best;
  for (int a = 0; a < node_count(type); ++a) converges_from(parametric_node(type, a));
  return best;
}

}  // namespace mixture_contact
