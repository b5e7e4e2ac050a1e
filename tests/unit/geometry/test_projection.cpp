#include "contact/geometry/projection.h"

#include "random_contact.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <boost/test/unit_test.hpp>

using namespace test;

namespace {

constexpr double edge_tolerance = 1e-12;

/// A line that intersects a facet at a known point.
struct Shot {
  FacetType type;
  FacetCoordinates x;
  Vector2d eta;
  double gap;
  Vector3d direction;

  Vector3d target() const { return x * shape_functions(type, eta).value; }
  Vector3d origin() const { return target() - gap * direction; }
  std::optional<RayHit> hit(double tolerance = edge_tolerance) const {
    return intersect(type, x, origin(), direction, tolerance);
  }
  double miss(const RayHit& found) const {
    return (x * shape_functions(type, found.eta).value - origin() - found.gap * direction).norm();
  }
  /// Upper bound of the change of the parametric coordinates and of the gap for a displacement of the point by 1.
  double sensitivity() const {
    Eigen::Matrix3d slope;
    slope << x * shape_functions(type, eta).gradient, -direction;
    return 1 / slope.jacobiSvd().singularValues()[2];
  }
};

Vector3d normal_at(const FacetCoordinates& x, const ShapeFunctions& shape) {
  const Eigen::Matrix<double, 3, 2> tangents = x * shape.gradient;
  return tangents.col(0).cross(tangents.col(1)).normalized();
}

/// A line through the point eta within about 30 degrees of the normal, from at most half a facet away on either side.
Shot random_shot(FacetType type, double noise, const Vector2d& eta, std::mt19937& random) {
  Shot shot{type, random_facet(type, noise, random), eta, random_vector(0.5, random)[0], {}};
  const Vector3d normal = normal_at(shot.x, shape_functions(type, eta));
  shot.direction = (normal + random_vector(0.3, random)).normalized();
  return shot;
}

void check_finite(const std::optional<RayHit>& hit) {
  if (!hit) return;
  BOOST_TEST(hit->eta.allFinite());
  BOOST_TEST(std::isfinite(hit->gap));
}

/// Checks that the hit is the known point within rounding.
void check_recovers(const Shot& shot, const std::optional<RayHit>& hit) {
  BOOST_REQUIRE(hit.has_value());
  BOOST_TEST(shot.miss(*hit) <= rounding);
  BOOST_TEST((hit->eta - shot.eta).norm() <= rounding * shot.sensitivity());
  BOOST_TEST(std::abs(hit->gap - shot.gap) <= rounding * shot.sensitivity());
}

Vector2d edge_point(FacetType type, double share) {
  return is_triangle(type) ? Vector2d(1 - share, share) : Vector2d(1, 2 * share - 1);
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_shot_at_a_flat_facet_hits_where_it_aims) {
  std::mt19937 random(1);
  for (const FacetType type : all_facets) {
    for (int sample = 0; sample < 100; ++sample) {
      const Shot shot = random_shot(type, 0, random_inside(type, random), random);
      check_recovers(shot, shot.hit());
    }
  }
}

BOOST_AUTO_TEST_CASE(a_shot_at_a_warped_or_curved_facet_hits_where_it_aims) {
  // Nodes are displaced by up to a twelfth of the distance to the next one. The facets are curved and warped, but a
  // line within 30 degrees of the normal intersects them only once.
  std::mt19937 random(2);
  for (const FacetType type : all_facets) {
    const double noise = is_triangle(type) ? 0.04 : 0.08;
    for (int sample = 0; sample < 300; ++sample) {
      const Shot shot = random_shot(type, noise, random_inside(type, random), random);
      check_recovers(shot, shot.hit());
    }
  }
}

BOOST_AUTO_TEST_CASE(edges_and_corners_belong_to_a_facet) {
  std::mt19937 random(3);
  for (const FacetType type : all_facets) {
    for (const double share : {0.0, 0.3, 1.0}) {
      const Shot shot = random_shot(type, 0.03, edge_point(type, share), random);
      check_recovers(shot, shot.hit());
    }
    for (int node = 0; node < node_count(type); ++node) {
      const Shot shot = random_shot(type, 0.03, parametric_node(type, node), random);
      check_recovers(shot, shot.hit());
    }
  }
}

BOOST_AUTO_TEST_CASE(a_hit_outside_counts_only_within_the_tolerance) {
  std::mt19937 random(4);
  for (const FacetType type : all_facets) {
    for (int sample = 0; sample < 20; ++sample) {
      const Vector2d centre = parametric_centre(type);
      const Vector2d edge = edge_point(type, 0.5);
      const Shot shot = random_shot(type, 0, centre + (edge - centre) * 1.05, random);
      const double distance = distance_outside(type, shot.eta);
      BOOST_TEST(!shot.hit(0.99 * distance).has_value());
      check_recovers(shot, shot.hit(1.01 * distance));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_curved_facet_is_hit_as_far_outside_as_the_tolerance_says) {
  std::mt19937 random(6);
  constexpr double tolerance = 0.1;
  for (const FacetType type : all_facets) {
    const Vector2d centre = parametric_centre(type);
    for (int node = 0; node < node_count(type); ++node) {
      const Vector2d away = parametric_node(type, node) - centre;
      for (int sample = 0; sample < 50; ++sample) {
        Shot shot = random_shot(type, 0.04, centre + 1.04 * away, random);
        BOOST_TEST(distance_outside(type, shot.eta) <= tolerance);
        shot.gap *= 100;  // far away
        check_finite(shot.hit(tolerance));
        BOOST_TEST(shot.hit(tolerance).has_value());
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(the_gap_has_the_sign_of_the_direction) {
  std::mt19937 random(5);
  const FacetCoordinates x = random_facet(FacetType::quad4, 0, random);
  const Vector3d up(0, 0, 1);
  BOOST_TEST(intersect(FacetType::quad4, x, {0.25, 0.5, -2}, up, 0)->gap == 2.0);
  BOOST_TEST(intersect(FacetType::quad4, x, {0.25, 0.5, 2}, up, 0)->gap == -2.0);
  BOOST_TEST(intersect(FacetType::quad4, x, {0.25, 0.5, 2}, -up, 0)->gap == 2.0);
  BOOST_TEST(intersect(FacetType::quad4, x, {0.25, 0.5, 0}, up, 0)->gap == 0.0);
  BOOST_TEST((intersect(FacetType::quad4, x, {0.25, 0.5, 2}, up, 0)->eta == Vector2d(0.25, 0.5)));
}

BOOST_AUTO_TEST_CASE(of_two_hits_on_a_curved_facet_the_nearer_one_counts) {
  // Lines close to the horizontal hit both flanks of the arch z = 1 - x^2, nearly 2 sqrt(1 - z) apart.
  std::mt19937 random(6);
  for (const FacetType type : {FacetType::quad8, FacetType::quad9}) {
    FacetCoordinates x = random_facet(type, 0, random);
    for (int a = 0; a < node_count(type); ++a) x(2, a) = 1 - x(0, a) * x(0, a);
    for (int sample = 0; sample < 100; ++sample) {
      const Vector3d direction = (Vector3d(1, 0, 0) + random_vector(0.1, random)).normalized();
      Vector3d origin(0, 0, 0.5);
      origin += random_vector(0.3, random);
      const std::optional<RayHit> hit = intersect(type, x, origin, direction, 0);
      // The line z(s) = z0 + s dz, x(s) = x0 + s dx intersects the arch where 1 - x^2 - z = 0.
      const double a = direction[0] * direction[0];
      const double b = 2 * origin[0] * direction[0] + direction[2];
      const double c = origin[0] * origin[0] + origin[2] - 1;
      const double root = std::sqrt(b * b - 4 * a * c);
      const double nearer = std::min(std::abs(-b + root), std::abs(-b - root)) / (2 * a);
      BOOST_REQUIRE(hit.has_value());
      BOOST_TEST(std::abs(std::abs(hit->gap) - nearer) <= 10 * rounding);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_line_parallel_to_a_facet_misses_it) {
  std::mt19937 random(7);
  for (const FacetType type : all_facets) {
    const FacetCoordinates x = random_facet(type, 0, random);
    for (const double height : {1e-12, 1e-3, 1.0}) {
      const Vector3d origin = x * shape_functions(type, parametric_centre(type)).value + Vector3d(0, 0, height);
      BOOST_TEST(!intersect(type, x, origin, Vector3d(0.6, 0.8, 0), 0.01).has_value());
    }
  }
}

BOOST_AUTO_TEST_CASE(a_line_nearly_parallel_to_a_facet_gives_finite_numbers_or_nothing) {
  std::mt19937 random(8);
  for (const FacetType type : all_facets) {
    for (const double noise : {0.0, 0.05}) {
      for (const double slope : {0.0, 1e-300, 1e-16, 1e-12, 1e-8, 1e-4}) {
        const FacetCoordinates x = random_facet(type, noise, random);
        const Vector3d direction = Vector3d(0.6, 0.8, slope).normalized();
        check_finite(intersect(type, x, random_vector(1, random), direction, 0.01));
        check_finite(intersect(type, x, x.col(0), direction, 0.01));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_collapsed_facet_gives_finite_numbers_or_nothing) {
  std::mt19937 random(9);
  for (const FacetType type : all_facets) {
    FacetCoordinates x = random_facet(type, 0.05, random);
    FacetCoordinates point = x.col(0).replicate(1, x.cols());
    FacetCoordinates line = x;
    line.bottomRows(2).setZero();
    FacetCoordinates folded = x;
    folded.col(2) = x.col(0);
    for (const FacetCoordinates& collapsed : {point, line, folded}) {
      for (int sample = 0; sample < 20; ++sample) {
        const Vector3d direction = random_vector(1, random).normalized();
        check_finite(intersect(type, collapsed, random_vector(1, random), direction, 0.01));
        check_finite(intersect(type, collapsed, collapsed.col(0), direction, 0.01));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_quadrilateral_with_two_nodes_in_one_place_is_hit_like_a_triangle) {
  std::mt19937 random(10);
  for (int sample = 0; sample < 50; ++sample) {
    Shot shot = random_shot(FacetType::quad4, 0.05, 0.9 * random_inside(FacetType::quad4, random), random);
    shot.x.col(3) = shot.x.col(2);
    check_recovers(shot, shot.hit());
  }
}

BOOST_AUTO_TEST_CASE(coordinates_that_are_not_numbers_give_no_hit) {
  std::mt19937 random(11);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const FacetType type : all_facets) {
    const FacetCoordinates x = random_facet(type, 0, random);
    const Vector3d up(0, 0, 1);
    FacetCoordinates broken = x;
    broken(2, 1) = nan;
    BOOST_TEST(!intersect(type, broken, {0.2, 0.2, 0}, up, 0.01).has_value());
    BOOST_TEST(!intersect(type, x, {nan, 0, 0}, up, 0.01).has_value());
    BOOST_TEST(!intersect(type, x, {0, 0, infinity}, up, 0.01).has_value());
    BOOST_TEST(!intersect(type, x, {0.2, 0.2, 0}, Vector3d(0, 0, 0), 0.01).has_value());
  }
}

BOOST_AUTO_TEST_CASE(a_strongly_warped_quadrilateral_is_hit_where_its_bilinear_equation_says) {
  // Nodes are displaced by up to 0.4 at a size of 2. For any shape, the hit is a point of both facet and line, and not
  // farther away than the known point.
  std::mt19937 random(12);
  for (int sample = 0; sample < 2000; ++sample) {
    const Shot shot = random_shot(FacetType::quad4, 0.4, random_inside(FacetType::quad4, random), random);
    const std::optional<RayHit> hit = shot.hit();
    BOOST_REQUIRE(hit.has_value());
    BOOST_TEST(shot.miss(*hit) <= rounding);
    BOOST_TEST(std::abs(hit->gap) <= std::abs(shot.gap) + rounding * shot.sensitivity());
  }
}
