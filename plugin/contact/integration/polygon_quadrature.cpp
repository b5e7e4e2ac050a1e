#include "integration/polygon_quadrature.h"

#include "geometry/quadrature.h"

#include <cmath>
#include <limits>

namespace mixture_contact {
namespace {

/// Sum of the corners of a polygon with given weights.
VaryingVector combined(const Polygon& corners, const Eigen::Ref<const VectorXd>& weights) {
  VaryingVector sum = weights[0] * corners[0];
  for (Index a = 1; a < count_of(corners); ++a) sum = sum + weights[a] * at(corners, a);
  return sum;
}

/// Of a polygon of three or four corners.
FacetType shape_of(const Polygon& polygon) { return polygon.size() == 3 ? FacetType::tri3 : FacetType::quad4; }

/// Twice the area of a polygon and the centre of it.
struct Middle {
  VaryingNumber twice_area;
  VaryingVector centroid;
};

Middle middle(const Polygon& polygon, const VaryingVector& n) {
  VaryingNumber area = triple(n, polygon[1] - polygon[0], polygon[2] - polygon[0]);
  VaryingVector moment = area * (polygon[1] + polygon[2] - 2 * polygon[0]);
  for (std::size_t i = 3; i < polygon.size(); ++i) {
    const VaryingVector one = polygon[i - 1] - polygon[0];
    const VaryingVector two = polygon[i] - polygon[0];
    const VaryingNumber part = triple(n, one, two);
    area = area + part;
    moment = moment + part * (one + two);
  }
  const VaryingNumber third{1 / (3 * area.value), -area.variation / (3 * area.value * area.value)};
  return {area, polygon[0] + third * moment};
}

/// A symmetric matrix in the directions of an alignment.
struct Symmetric {
  VaryingNumber xx;
  VaryingNumber xy;
  VaryingNumber yy;
};

/// The covariance of a polygon: the mean of u u about the centroid, where u = x e1 + y e2 as it appears along n.
Symmetric covariance(const Polygon& polygon, const VaryingVector& n, const Alignment& aligned, const Middle& middle) {
  const VaryingNumber unit = triple(n, aligned.first, aligned.second);
  struct Coordinates {
    VaryingNumber x;
    VaryingNumber y;
  };
  std::vector<Coordinates> corners;
  corners.reserve(polygon.size());
  for (const VaryingVector& corner : polygon) {
    const VaryingVector u = corner - middle.centroid;
    corners.push_back({triple(n, u, aligned.second) / unit, triple(n, aligned.first, u) / unit});
  }
  // Of a triangle 0, u, v: INT x x da = area/12 (u u + v v + (u + v)(u + v)).
  const auto zero = 0.0 * unit;
  Symmetric sum{zero, zero, zero};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& [ux, uy] = corners[i];
    const auto& [vx, vy] = corners[(i + 1) % corners.size()];
    const VaryingNumber part = ux * vy - uy * vx;
    const VaryingNumber x = ux + vx;
    const VaryingNumber y = uy + vy;
    sum.xx = sum.xx + part * (ux * ux + vx * vx + x * x);
    sum.xy = sum.xy + part * (ux * uy + vx * vy + x * y);
    sum.yy = sum.yy + part * (uy * uy + vy * vy + y * y);
  }
  const VaryingNumber share = unit / (12 * middle.twice_area);
  return {share * sum.xx, share * sum.xy, share * sum.yy};
}

/// The symmetric root S of a positive M: S = (M + sqrt(det M) I)/sqrt(tr M + 2 sqrt(det M)). A determinant that is
/// rounding is 0: of a sliver whose area is rounding, too.
Symmetric root(const Symmetric& m) {
  const VaryingNumber determinant = m.xx * m.yy - m.xy * m.xy;
  const bool sliver = determinant.value <= 4 * std::numeric_limits<double>::epsilon() * m.xx.value * m.yy.value;
  const VaryingNumber part = sliver ? 0.0 * determinant : sqrt(determinant);
  const VaryingNumber scale = sqrt(m.xx + m.yy + 2 * part);
  return {(m.xx + part) / scale, m.xy / scale, (m.yy + part) / scale};
}

/// Directions of unit covariance: to the corners of a square, or of a triangle with equal sides.
Eigen::Matrix2Xd directions(FacetType type) {
  Eigen::Matrix2Xd result(2, is_triangle(type) ? 3 : 4);
  if (is_triangle(type)) {
    const double root = std::sqrt(1.5);
    result << -root, root, 0, -std::sqrt(0.5), -std::sqrt(0.5), std::sqrt(2.0);
  } else {
    result << -1, 1, 1, -1, -1, -1, 1, 1;
  }
  return result;
}

/// Points on the ellipse of inertia.
std::vector<PolygonPoint> points_of_inertia(const Polygon& polygon, const VaryingVector& n, const Alignment& aligned) {
  const Middle middle_of = middle(polygon, n);
  const Symmetric s = root(covariance(polygon, n, aligned, middle_of));
  const Eigen::Matrix2Xd to = directions(aligned.type);
  const VaryingNumber area = 0.5 / static_cast<double>(to.cols()) * middle_of.twice_area;
  std::vector<PolygonPoint> points;
  points.reserve(static_cast<std::size_t>(to.cols()));
  for (Index q = 0; q < to.cols(); ++q) {
    const VaryingNumber x = to(0, q) * s.xx + to(1, q) * s.xy;
    const VaryingNumber y = to(0, q) * s.xy + to(1, q) * s.yy;
    points.push_back({middle_of.centroid + x * aligned.first + y * aligned.second, area});
  }
  return points;
}

/// A quadrilateral as it is; any other polygon as triangles around its centroid.
std::vector<Polygon> pieces(const Polygon& polygon, const VaryingVector& n) {
  if (polygon.size() == 4) return {polygon};
  const VaryingVector centre = middle(polygon, n).centroid;
  std::vector<Polygon> triangles;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    triangles.push_back({centre, polygon[i], polygon[(i + 1) % polygon.size()]});
  }
  return triangles;
}

/// Points of the rules of triangles and quadrilaterals.
std::vector<PolygonPoint> points_of_pieces(const Polygon& polygon, const VaryingVector& n, int order) {
  std::vector<PolygonPoint> points;
  for (const Polygon& piece : pieces(polygon, n)) {
    const FacetType type = shape_of(piece);
    for (const QuadraturePoint& q : quadrature(type, order)) {
      const ShapeFunctions shape = shape_functions(type, q.xi);
      const VaryingNumber area = triple(n, combined(piece, shape.gradient.col(0)),
                                        combined(piece, shape.gradient.col(1)));
      if (area.value > 0) points.push_back({combined(piece, shape.value), q.weight * area});
    }
  }
  return points;
}

}  // namespace

Alignment alignment(const Polygon& polygon) {
  const FacetType type = shape_of(polygon);
  const FacetGradient gradient = shape_functions(type, parametric_centre(type)).gradient;
  const VaryingVector first = combined(polygon, gradient.col(0));
  const VaryingVector second = combined(polygon, gradient.col(1));
  if (!is_triangle(type)) return {type, first, second};
  return {type, first, 1 / std::sqrt(3.0) * (2 * second - first)};
}

std::vector<PolygonPoint> polygon_quadrature(const Polygon& polygon, const VaryingVector& n, const Alignment& aligned,
                                             int order) {
  if (order == 2) return points_of_inertia(polygon, n, aligned);
  if (order > 2) return points_of_pieces(polygon, n, order);
  const Middle only = middle(polygon, n);
  return {{only.centroid, 0.5 * only.twice_area}};
}

}  // namespace mixture_contact
