#include "contact/integration/polygon_quadrature.h"

#include "contact/geometry/quadrature.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

using namespace mixture_contact;

namespace {

/// Rounding error of sums over tens of points of numbers of size 1.
constexpr double exact = 1e-14;

using Corners = std::vector<Vector2d>;
using Points = std::vector<std::pair<Vector2d, double>>;

const Corners square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
const Corners triangle{{0, 0}, {1, 0}, {0, 1}};
/// Polygons of three to six corners without symmetry.
const std::array<Corners, 4> polygons{{{{0.1, 0.2}, {0.9, 0.3}, {0.4, 0.8}},
                                       {{0.1, 0.2}, {0.8, 0.1}, {0.9, 0.7}, {0.2, 0.5}},
                                       {{0.1, 0.2}, {0.6, 0.1}, {0.9, 0.4}, {0.7, 0.8}, {0.2, 0.7}},
                                       {{0.1, 0.4}, {0.3, 0.1}, {0.8, 0.1}, {0.9, 0.4}, {0.6, 0.9}, {0.2, 0.7}}}};

Polygon<double> polygon_of(const Corners& corners) {
  Polygon<double> polygon;
  for (const Vector2d& corner : corners) polygon.push_back({corner[0], corner[1]});
  return polygon;
}

/// Quadrature points in the plane with their areas.
Points points_of(const Corners& corners, const Corners& facet, int order) {
  Points points;
  for (const auto& [place, area] : polygon_quadrature(polygon_of(corners), alignment(polygon_of(facet)), order)) {
    points.emplace_back(place.value(), area);
  }
  return points;
}

double integral(const Points& points, const std::function<double(const Vector2d&)>& f) {
  double sum = 0;
  for (const auto& [place, area] : points) sum += area * f(place);
  return sum;
}

/// INT x^a y^b over a polygon, by a rule of high degree on its triangles.
double moment(const Corners& corners, int a, int b) {
  double sum = 0;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Vector2d one = corners[i - 1] - corners[0];
    const Vector2d two = corners[i] - corners[0];
    for (const QuadraturePoint& q : quadrature(FacetType::tri3, 6)) {
      const Vector2d x = corners[0] + q.xi[0] * one + q.xi[1] * two;
      sum += q.weight * (one[0] * two[1] - one[1] * two[0]) * std::pow(x[0], a) * std::pow(x[1], b);
    }
  }
  return sum;
}

double error_of_moment(const Points& points, const Corners& corners, int a, int b) {
  return integral(points, [&](const Vector2d& x) { return std::pow(x[0], a) * std::pow(x[1], b); }) -
         moment(corners, a, b);
}

bool inside(const Corners& corners, const Vector2d& x) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2d edge = corners[(i + 1) % corners.size()] - corners[i];
    const Vector2d to = x - corners[i];
    if (edge[0] * to[1] - edge[1] * to[0] < -exact) return false;
  }
  return true;
}

/// True if two rules have the same points in any order.
bool alike(const Points& one, const Points& other) {
  return one.size() == other.size() && std::all_of(one.begin(), one.end(), [&](const auto& point) {
           return std::any_of(other.begin(), other.end(), [&](const auto& match) {
             return (point.first - match.first).norm() <= exact && std::abs(point.second - match.second) <= exact;
           });
         });
}

Corners turned(Corners corners, std::size_t first) {
  std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(first), corners.end());
  return corners;
}

/// The polygon mirrored at x = 0, with corners counter-clockwise.
Corners mirrored(Corners corners) {
  for (Vector2d& corner : corners) corner[0] = -corner[0];
  std::reverse(corners.begin(), corners.end());
  return corners;
}

}  // namespace

BOOST_AUTO_TEST_CASE(points_of_a_mirrored_polygon_are_mirrored) {
  for (const Corners& polygon : polygons) {
    for (const Corners& facet : {square, triangle}) {
      for (const int order : {1, 2, 3}) {
        Points points = points_of(polygon, facet, order);
        for (auto& [place, area] : points) place[0] = -place[0];
        BOOST_TEST(alike(points, points_of(mirrored(polygon), mirrored(facet), order)));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(polynomials_are_exact_to_the_degree_of_the_rule_and_not_beyond) {
  for (const Corners& polygon : polygons) {
    for (const Corners& facet : {square, triangle}) {
      for (const int order : {1, 2}) {
        const Points points = points_of(polygon, facet, order);
        double beyond = 0;
        for (int a = 0; a <= order + 1; ++a) {
          for (int b = 0; a + b <= order; ++b) BOOST_TEST(std::abs(error_of_moment(points, polygon, a, b)) <= exact);
          beyond = std::max(beyond, std::abs(error_of_moment(points, polygon, a, order + 1 - a)));
        }
        BOOST_TEST(beyond > 1e6 * exact);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(the_third_degree_is_exact_on_what_is_symmetric_about_its_centroid) {
  const Corners oblique{{0.1, 0.2}, {0.8, 0.3}, {0.9, 0.7}, {0.2, 0.6}};
  const Points points = points_of(oblique, square, 2);
  for (int a = 0; a <= 3; ++a) BOOST_TEST(std::abs(error_of_moment(points, oblique, a, 3 - a)) <= exact);
}

BOOST_AUTO_TEST_CASE(the_whole_facet_has_the_points_of_its_own_rule) {
  const Corners parallelogram{{0.1, 0.2}, {0.8, 0.3}, {0.9, 0.7}, {0.2, 0.6}};
  Points gauss;
  for (const QuadraturePoint& q : quadrature(FacetType::quad4, 2)) {
    const Vector2d along = 0.5 * (parallelogram[1] - parallelogram[0]);
    const Vector2d across = 0.5 * (parallelogram[3] - parallelogram[0]);
    const Vector2d middle = parallelogram[0] + along + across;
    gauss.emplace_back(middle + q.xi[0] * along + q.xi[1] * across,
                       q.weight * (along[0] * across[1] - along[1] * across[0]));
  }
  BOOST_TEST(alike(points_of(parallelogram, parallelogram, 2), gauss));

  const Corners& corners = polygons[0];
  Points inner;
  for (const QuadraturePoint& q : quadrature(FacetType::tri3, 2)) {
    inner.emplace_back(corners[0] + q.xi[0] * (corners[1] - corners[0]) + q.xi[1] * (corners[2] - corners[0]),
                       2 * q.weight * moment(corners, 0, 0));
  }
  BOOST_TEST(alike(points_of(corners, corners, 2), inner));
}

BOOST_AUTO_TEST_CASE(points_lie_within_the_polygon_and_have_positive_areas) {
  for (const Corners& polygon : polygons) {
    for (const Corners& facet : {square, triangle}) {
      for (const int order : {1, 2, 3}) {
        for (const auto& [place, area] : points_of(polygon, facet, order)) {
          BOOST_TEST(inside(polygon, place));
          BOOST_TEST(area > 0);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(points_do_not_depend_on_the_first_corner_of_polygon_or_facet) {
  for (const Corners& polygon : polygons) {
    for (const Corners& facet : {square, triangle}) {
      const Points points = points_of(polygon, facet, 2);
      for (std::size_t first = 1; first < facet.size(); ++first) {
        BOOST_TEST(alike(points_of(turned(polygon, first), turned(facet, first), 2), points));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_corner_twice_changes_nothing) {
  Corners twice = polygons[1];
  twice.insert(twice.begin() + 2, twice[2]);
  for (const int order : {1, 2})
    BOOST_TEST(alike(points_of(twice, square, order), points_of(polygons[1], square, order)));
}

BOOST_AUTO_TEST_CASE(order_three_is_exact_to_the_third_degree_whatever_the_corners) {
  // On a quadrilateral that is no parallelogram, the Jacobian reduces the degree five by one.
  for (const Corners& polygon : polygons) {
    const Points points = points_of(polygon, square, 3);
    for (int a = 0; a <= 3; ++a) {
      for (int b = 0; a + b <= 3; ++b) BOOST_TEST(std::abs(error_of_moment(points, polygon, a, b)) <= exact);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_sliver_has_its_area_on_its_middle_line) {
  // Corners are rounded to 1e-16, and so the width of the sliver to 1e-4 of itself. The rounding error of the
  // covariance is 1e-16, and that of its root 1e-8.
  const double width = 1e-12;
  const Corners sliver{{0, 0}, {1, 1}, {1 - width, 1 + width}, {-width, width}};
  const Points points = points_of(sliver, square, 2);
  BOOST_TEST(std::abs(integral(points, [](const Vector2d&) { return 1.0; }) / (2 * width) - 1) <= 1e-3);
  for (const auto& [place, area] : points) BOOST_TEST(std::abs(place[0] - place[1]) <= 1e-6);
}
