#include "contact/geometry/kinematics.h"

#include "random_contact.h"

#include <boost/test/unit_test.hpp>

using namespace test;

namespace {

constexpr int samples = 10;

/// Calls `check` for random contacts without fields, for every pair of facet types. Their unknowns are the nodal
/// positions.
template <class Check>
void for_every_pair(unsigned seed, const Check& check) {
  std::mt19937 random(seed);
  for (const auto& [one, two] : facet_pairs()) {
    for (int sample = 0; sample < samples; ++sample) check(RandomContact(one, two, 0, random));
  }
}

/// Gap, projected point, area vector and area, shape (7).
VectorXd quantities(const RandomContact& contact, const VectorXd& q) {
  const PointKinematics point = contact.kinematics(q);
  VectorXd result(7);
  result << point.gap, contact.projection(q).eta, point.area_vector, point.area;
  return result;
}

MatrixXd exact_variations(const RandomContact& contact) {
  const KinematicVariations vary = kinematic_variations(contact.kinematics(contact.unknowns));
  MatrixXd result(7, contact.unknowns.size());
  result << vary.gap, vary.eta, vary.area_vector, vary.area;
  return result;
}

/// Velocity of all nodes in a rigid motion.
VectorXd rigid_velocity(const RandomContact& contact, const Vector3d& translation, const Vector3d& spin) {
  VectorXd velocity(contact.unknowns.size());
  for (Index node = 0; node < contact.layout.nodes(); ++node) {
    const Vector3d x = contact.unknowns.segment<3>(contact.layout.displacement(node, 0));
    velocity.segment<3>(contact.layout.displacement(node, 0)) = translation + spin.cross(x);
  }
  return velocity;
}

}  // namespace

BOOST_AUTO_TEST_CASE(variations_match_differences_for_every_pair_of_facets) {
  constexpr std::array<std::array<Index, 2>, 4> rows{{{0, 1}, {1, 2}, {3, 3}, {6, 1}}};  // gap, eta, area vector, area
  double worst = 0;
  for_every_pair(1, [&](const RandomContact& contact) {
    const MatrixXd exact = exact_variations(contact);
    const MatrixXd approximate = differences([&](const VectorXd& q) { return quantities(contact, q); },
                                             contact.unknowns);
    for (const auto& [first, count] : rows) {
      const double error = relative_error(approximate.middleRows(first, count), exact.middleRows(first, count));
      worst = std::max(worst, error);
      BOOST_TEST(error <= difference_tolerance);
    }
  });
  BOOST_TEST_MESSAGE("kinematic variations, largest relative difference " << worst);
}

BOOST_AUTO_TEST_CASE(the_projected_point_lies_on_the_normal_at_the_distance_of_the_gap) {
  for_every_pair(2, [](const RandomContact& contact) {
    const VectorXd& q = contact.unknowns;
    const PointKinematics point = contact.kinematics(q);
    const Vector3d x1 = contact.coordinates(q, true) * point.primary_shape;
    const Vector3d x2 = contact.coordinates(q, false) * point.secondary_shape;
    BOOST_TEST((x2 - x1 - point.gap * point.normal).norm() <= rounding);
    BOOST_TEST(std::abs(point.normal.norm() - 1) <= rounding);
    BOOST_TEST((point.area * point.normal - point.area_vector).norm() <= rounding);
  });
}

BOOST_AUTO_TEST_CASE(weights_of_a_jump_add_up_to_zero) {
  for_every_pair(3, [](const RandomContact& contact) {
    const PairVector h = contact.kinematics(contact.unknowns).jump_weights();
    BOOST_TEST(h.size() == contact.layout.nodes());
    BOOST_TEST(std::abs(h.sum()) <= rounding);
    BOOST_TEST(std::abs(h.head(contact.layout.primary_nodes()).sum() - 1) <= rounding);
  });
}

BOOST_AUTO_TEST_CASE(a_rigid_motion_changes_no_gap_no_projection_and_no_area) {
  std::mt19937 random(4);
  for_every_pair(4, [&](const RandomContact& contact) {
    const Vector3d spin = random_vector(1, random);
    const VectorXd velocity = rigid_velocity(contact, random_vector(1, random), spin);
    const VectorXd rate = exact_variations(contact) * velocity;
    const Vector3d turned = spin.cross(contact.kinematics(contact.unknowns).area_vector);
    BOOST_TEST(std::abs(rate[0]) <= rounding);
    BOOST_TEST(rate.segment<2>(1).norm() <= rounding);
    BOOST_TEST((rate.segment<3>(3) - turned).norm() <= rounding);
    BOOST_TEST(std::abs(rate[6]) <= rounding);
  });
}

BOOST_AUTO_TEST_CASE(lifting_the_secondary_facet_along_the_normal_opens_the_gap_as_much) {
  for_every_pair(5, [](const RandomContact& contact) {
    const PointKinematics point = contact.kinematics(contact.unknowns);
    const Index n2 = contact.layout.nodes() - contact.layout.primary_nodes();
    const VectorXd velocity = point.normal.replicate(n2, 1);
    const KinematicVariations vary = kinematic_variations(point);
    BOOST_TEST(std::abs(vary.gap.tail(3 * n2).dot(velocity) - 1) <= rounding);
    BOOST_TEST((vary.eta.rightCols(3 * n2) * velocity).norm() <= rounding);
    BOOST_TEST(vary.area_vector.rightCols(3 * n2).norm() == 0.0);
  });
}

BOOST_AUTO_TEST_CASE(an_overlap_is_a_negative_gap) {
  FacetCoordinates below(3, 3);
  below << 0, 1, 0, 0, 0, 1, 0, 0, 0;
  FacetCoordinates above(3, 3);
  above << 0, 0, 1, 0, 1, 0, -0.25, -0.25, -0.25;
  const ShapeFunctions centre = shape_functions(FacetType::tri3, parametric_centre(FacetType::tri3));
  const PointKinematics point = point_kinematics(centre, below, centre, above);
  BOOST_TEST((point.area_vector == Vector3d(0, 0, 1)));
  BOOST_TEST(std::abs(point.gap + 0.25) <= rounding);
}

BOOST_AUTO_TEST_CASE(a_point_moved_on_flat_facets_is_the_one_evaluated_there) {
  std::mt19937 random(6);
  for (int sample = 0; sample < samples; ++sample) {
    FacetCoordinates x1(3, 3);
    FacetCoordinates x2(3, 3);
    for (Index node = 0; node < 3; ++node) {
      x1.col(node) = random_vector(1, random);
      x2.col(node) = random_vector(1, random);
    }
    const auto shapes_at = [](double xi, double eta) { return shape_functions(FacetType::tri3, {xi, eta}); };
    PointKinematics moved = point_kinematics(shapes_at(0.2, 0.3), x1, shapes_at(0.5, 0.1), x2);
    const ShapeFunctions primary = shapes_at(0.6, 0.1);
    const ShapeFunctions secondary = shapes_at(0.1, 0.4);
    move_on_flat_facets(moved, primary.value, x1, secondary.value, x2);
    const PointKinematics there = point_kinematics(primary, x1, secondary, x2);
    BOOST_TEST(moved.gap == there.gap);
    BOOST_TEST((moved.jump_weights() == there.jump_weights()));
    BOOST_TEST((moved.primary_tangents == there.primary_tangents));
    BOOST_TEST((moved.secondary_tangents == there.secondary_tangents));
    BOOST_TEST((moved.area_vector == there.area_vector));
  }
}
