#include "integration/polygon_quadrature.h"

#include "base/indexed_vector.h"
#include "geometry/quadrature.h"

#include <cmath>
#include <limits>

namespace mixture_contact {
namespace {

/// Weighted sum of the corners of a polygon.
template <class Number>
Place<Number> combined(const Polygon<Number>& corners, const Eigen::Ref<const VectorXd>& weights) {
  Place<Number> sum = weights[0] * corners[0];
  for (Index a = 1; a < count_of(corners); ++a) sum = sum + weights[a] * at(corners, a);
  return sum;
}

/// The facet type of a polygon with three or four corners.
template <class Number>
FacetType shape_of(const Polygon<Number>& polygon) {
  return polygon.size() == 3 ? FacetType::tri3 : FacetType::quad4;
}

/// Twice the area of a polygon, and its centroid.
template <class Number>
struct Middle {
  Number twice_area;
  Place<Number> centroid;
};

template <class Number>
Middle<Number> middle(const Polygon<Number>& polygon) {
  Number area{0};
  Place<Number> moment;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Place<Number> one = polygon[i - 1] - polygon[0];
    const Place<Number> two = polygon[i] - polygon[0];
    const Number part = cross(one, two);
    area += part;
    moment = moment + part * (one + two);
  }
  const Number third = 1 / (3 * area);
  return {area, polygon[0] + third * moment};
}

template <class Number>
struct Symmetric {
  Number xx{0};
  Number xy{0};
  Number yy{0};
};

/// Twelve times the second moments INT u u da of a polygon, where u is the position relative to the centroid.
template <class Number>
Symmetric<Number> inertia(const Polygon<Number>& polygon, const Place<Number>& centroid) {
  // For a triangle with corners 0, u, v: INT x x da = area/12 (u u + v v + (u + v)(u + v)).
  Symmetric<Number> sum;
  Place<Number> u = polygon.back() - centroid;
  for (const Place<Number>& corner : polygon) {
    const Place<Number> v = corner - centroid;
    const Place<Number> both = u + v;
    const Number part = 0.5 * cross(u, v);
    sum.xx += part * (u.x * u.x + v.x * v.x + both.x * both.x);
    sum.xy += part * (u.x * u.y + v.x * v.y + both.x * both.y);
    sum.yy += part * (u.y * u.y + v.y * v.y + both.y * both.y);
    u = v;
  }
  return sum;
}

/// The covariance of a polygon in the axes e1, e2 of an alignment: the mean of u u about the centroid in the
/// coordinates of u = x e1 + y e2, x = (u x e2)/(e1 x e2), y = (e1 x u)/(e1 x e2).
template <class Number>
Symmetric<Number> covariance(const Polygon<Number>& polygon, const Alignment<Number>& aligned,
                             const Middle<Number>& middle) {
  const Symmetric<Number> m = inertia(polygon, middle.centroid);
  const Place<Number>& a = aligned.first;
  const Place<Number>& b = aligned.second;
  const Number unit = cross(a, b);
  const Number share = 1 / (6 * middle.twice_area * unit * unit);
  const Place<Number> mb{b.y * m.xx - b.x * m.xy, b.y * m.xy - b.x * m.yy};
  const Place<Number> ma{a.x * m.xy - a.y * m.xx, a.x * m.yy - a.y * m.xy};
  return {share * (b.y * mb.x - b.x * mb.y), share * (b.y * ma.x - b.x * ma.y), share * (a.x * ma.y - a.y * ma.x)};
}

/// The symmetric square root S of a positive matrix M: S = (M + sqrt(det M) I)/sqrt(tr M + 2 sqrt(det M)). A
/// determinant within rounding counts as 0, as for a sliver.
template <class Number>
Symmetric<Number> root(const Symmetric<Number>& m) {
  using std::sqrt;
  const Number determinant = m.xx * m.yy - m.xy * m.xy;
  const bool sliver = value_of(determinant) <=
                      4 * std::numeric_limits<double>::epsilon() * value_of(m.xx) * value_of(m.yy);
  Number part{0};
  if (!sliver) part = sqrt(determinant);
  const Number share = 1 / sqrt(m.xx + m.yy + 2 * part);
  return {(m.xx + part) * share, m.xy * share, (m.yy + part) * share};
}

/// Vectors to the corners of a square or an equilateral triangle whose covariance is the unit matrix.
using Directions = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, 4>;
Directions directions(FacetType type) {
  Directions result(2, is_triangle(type) ? 3 : 4);
  if (is_triangle(type)) {
    const double root = std::sqrt(1.5);
    result << -root, root, 0, -std::sqrt(0.5), -std::sqrt(0.5), std::sqrt(2.0);
  } else {
    result << -1, 1, 1, -1, -1, -1, 1, 1;
  }
  return result;
}

/// The quadrature points of order 2, on the ellipse of inertia.
template <class Number>
PolygonPoints<Number> points_of_inertia(const Polygon<Number>& polygon, const Alignment<Number>& aligned) {
  const Middle<Number> middle_of = middle(polygon);
  const Symmetric<Number> s = root(covariance(polygon, aligned, middle_of));
  const Place<Number> first = s.xx * aligned.first + s.xy * aligned.second;
  const Place<Number> second = s.xy * aligned.first + s.yy * aligned.second;
  const Directions to = directions(aligned.type);
  const Number area = 0.5 / static_cast<double>(to.cols()) * middle_of.twice_area;
  PolygonPoints<Number> points(polygon.get_allocator());
  points.reserve(static_cast<std::size_t>(to.cols()));
  for (Index q = 0; q < to.cols(); ++q) {
    points.push_back({middle_of.centroid + to(0, q) * first + to(1, q) * second, area});
  }
  return points;
}

/// Divides a polygon for quadrature: a quadrilateral stays as it is, any other polygon becomes triangles around its
/// centroid.
template <class Number>
std::vector<Polygon<Number>> pieces(const Polygon<Number>& polygon) {
  if (polygon.size() == 4) return {polygon};
  const Place<Number> centre = middle(polygon).centroid;
  std::vector<Polygon<Number>> triangles;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    triangles.push_back({centre, polygon[i], polygon[(i + 1) % polygon.size()]});
  }
  return triangles;
}

/// The quadrature points of higher orders, from the rules on triangles and quadrilaterals.
template <class Number>
PolygonPoints<Number> points_of_pieces(const Polygon<Number>& polygon, int order) {
  PolygonPoints<Number> points(polygon.get_allocator());
  for (const Polygon<Number>& piece : pieces(polygon)) {
    const FacetType type = shape_of(piece);
    for (const QuadraturePoint& q : quadrature(type, order)) {
      const ShapeFunctions shape = shape_functions(type, q.xi);
      const Number area = cross(combined(piece, shape.gradient.col(0)), combined(piece, shape.gradient.col(1)));
      if (value_of(area) > 0) points.push_back({combined(piece, shape.value), q.weight * area});
    }
  }
  return points;
}

}  // namespace

template <class Number>
Alignment<Number> alignment(const Polygon<Number>& polygon) {
  const FacetType type = shape_of(polygon);
  const FacetGradient gradient = shape_functions(type, parametric_centre(type)).gradient;
  const Place<Number> first = combined(polygon, gradient.col(0));
  const Place<Number> second = combined(polygon, gradient.col(1));
  if (!is_triangle(type)) return {type, first, second};
  return {type, first, 1 / std::sqrt(3.0) * (2.0 * second - first)};
}

template <class Number>
PolygonPoints<Number> polygon_quadrature(const Polygon<Number>& polygon, const Alignment<Number>& aligned, int order) {
  if (order == 2) return points_of_inertia(polygon, aligned);
  if (order > 2) return points_of_pieces(polygon, order);
  const Middle<Number> only = middle(polygon);
  return {{{only.centroid, 0.5 * only.twice_area}}, polygon.get_allocator()};
}

template <class Number>
using Align = Alignment<Number>(const Polygon<Number>&);
template Align<double> alignment;
template Align<VaryingNumber<corners_of_triangles>> alignment;
template Align<VaryingNumber<corners_of_pieces>> alignment;
template Align<VaryingNumber<most_corners>> alignment;

template <class Number>
using Quadrature = PolygonPoints<Number>(const Polygon<Number>&, const Alignment<Number>&, int);
template Quadrature<double> polygon_quadrature;
template Quadrature<VaryingNumber<corners_of_triangles>> polygon_quadrature;
template Quadrature<VaryingNumber<corners_of_pieces>> polygon_quadrature;
template Quadrature<VaryingNumber<most_corners>> polygon_quadrature;

}  // namespace mixture_contact
