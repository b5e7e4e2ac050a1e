#include "contact/geometry/circle.h"

#include "contact/geometry/projection.h"
#include "surfaces.h"

#include <boost/test/unit_test.hpp>

using namespace test;

namespace {

FacetCoordinates random_triangle(std::mt19937& random) {
  FacetCoordinates x(3, 3);
  for (Index node = 0; node < x.cols(); ++node) x.col(node) = random_vector(1, random);
  return x;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_line_that_meets_a_triangle_does_not_pass_its_circle) {
  std::mt19937 random(1);
  int hits = 0;
  int passes = 0;
  for (int n = 0; n < 2000; ++n) {
    const FacetCoordinates x = random_triangle(random);
    const Vector3d origin = random_vector(2, random);
    const Vector3d target = x.rowwise().mean() + random_vector(1, random);
    const Vector3d direction = (target - origin).normalized();
    const bool hit = intersect(FacetType::tri3, x, origin, direction, 0).has_value();
    const bool passed = is_passed(circle_around(x), origin, direction);
    hits += hit ? 1 : 0;
    passes += passed ? 1 : 0;
    BOOST_TEST(!(hit && passed));
  }
  BOOST_TEST(hits > 100);
  BOOST_TEST(passes > 100);
}

BOOST_AUTO_TEST_CASE(a_line_through_a_corner_does_not_pass) {
  std::mt19937 random(2);
  for (int n = 0; n < 200; ++n) {
    const FacetCoordinates x = random_triangle(random);
    const Circle circle = circle_around(x);
    for (Index node = 0; node < x.cols(); ++node) {
      // The corner that is farthest from the middle is on the circle in a projection along this direction.
      const Vector3d from_middle = x.col(node) - circle.centre;
      const Vector3d direction = from_middle.cross(random_vector(1, random)).normalized();
      BOOST_TEST(!is_passed(circle, x.col(node), direction));
      const Vector3d beyond = circle.centre + from_middle.normalized() * (1.001 * circle.radius);
      BOOST_TEST(is_passed(circle, beyond, direction));
    }
  }
}

BOOST_AUTO_TEST_CASE(circles_are_apart_as_they_are_seen) {
  const Circle one{{0, 0, 0}, 1};
  const Circle other{{2.5, 0, 0}, 1};
  BOOST_TEST(are_apart(one, other, {0, 0, 1}));
  BOOST_TEST(!are_apart(one, other, {1, 0, 0}));           // one is behind the other
  BOOST_TEST(!are_apart(one, {{2, 0, 0}, 1}, {0, 0, 1}));  // they touch
}
