#include "contact/geometry/slip.h"

#include "random_contact.h"

#include <boost/test/unit_test.hpp>

using namespace test;

namespace {

constexpr int samples = 5;

/// A random pair of facets with other nodal positions at the start of the step.
struct SlidingContact {
  RandomContact now;
  VectorXd past;

  SlidingContact(FacetType one, FacetType two, std::mt19937& random) : now(one, two, 0, random), past(now.unknowns) {
    for (Index node = 0; node < now.layout.nodes(); ++node)
      past.segment<3>(now.layout.displacement(node, 0)) += random_vector(0.1, random);
  }

  PastPoint past_point(const PointKinematics& point) const {
    return mixture_contact::past_point(point, now.coordinates(past, true), now.coordinates(past, false));
  }
  Vector3d slip_at(const VectorXd& q) const { return slip(past_point(now.kinematics(q))); }
};

template <class Check>
void for_every_pair(unsigned seed, const Check& check) {
  std::mt19937 random(seed);
  for (const auto& [one, two] : facet_pairs()) {
    for (int sample = 0; sample < samples; ++sample) check(SlidingContact(one, two, random), random);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_variation_of_the_slip_matches_differences_for_every_pair_of_facets) {
  double worst = 0;
  for_every_pair(1, [&](const SlidingContact& contact, std::mt19937& /*random*/) {
    const PointKinematics point = contact.now.kinematics(contact.now.unknowns);
    const PastPoint past = contact.past_point(point);
    const MatrixXd exact = slip_slope_with_eta(past) * kinematic_variations(point).eta;
    const MatrixXd approximate = differences([&](const VectorXd& q) -> VectorXd { return contact.slip_at(q); },
                                             contact.now.unknowns);
    worst = std::max(worst, relative_error(approximate, exact));
  });
  BOOST_TEST(worst <= difference_tolerance);
}

BOOST_AUTO_TEST_CASE(the_variation_with_the_place_matches_differences_for_every_facet) {
  double worst = 0;
  for_every_pair(2, [&](const SlidingContact& contact, std::mt19937& /*random*/) {
    const RandomContact& now = contact.now;
    const FacetCoordinates past1 = now.coordinates(contact.past, true);
    const FacetCoordinates past2 = now.coordinates(contact.past, false);
    const Vector2d eta = now.projection(now.unknowns).eta;
    const auto point_at = [&](const Vector2d& xi) {
      return point_kinematics(shape_functions(now.primary, xi), now.coordinates(now.unknowns, true),
                              shape_functions(now.secondary, eta), now.coordinates(now.unknowns, false));
    };
    const auto slip_at = [&](const VectorXd& xi) -> VectorXd { return slip(past_point(point_at(xi), past1, past2)); };
    const PastPoint past = past_point(point_at(now.xi), past1, past2);
    const Eigen::Matrix3d curvature = past1 * shape_hessian(now.primary, now.xi);
    const MatrixXd exact = slip_slope_with_xi(past, normal_slope(past, curvature));
    worst = std::max(worst, relative_error(differences(slip_at, now.xi), exact));
  });
  BOOST_TEST(worst <= difference_tolerance);
}

/// Both bodies rotate by 90 degrees and translate, with a constant gap between them.
BOOST_AUTO_TEST_CASE(a_rigid_motion_of_both_bodies_is_no_slip) {
  double worst = 0;
  for_every_pair(3, [&](const SlidingContact& contact, std::mt19937& random) {
    const RandomContact& now = contact.now;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5 * 3.14159265358979, random_vector(1, random).normalized())
                                     .toRotationMatrix();
    const Vector3d shift = random_vector(1, random);
    const auto moved = [&](const FacetCoordinates& x) -> FacetCoordinates { return (turn * x).colwise() + shift; };
    const PointKinematics before = now.kinematics(now.unknowns);
    BOOST_TEST(std::abs(before.gap) > 1e-3);
    const FacetCoordinates x1 = now.coordinates(now.unknowns, true);
    const FacetCoordinates x2 = now.coordinates(now.unknowns, false);
    const PointKinematics after = point_kinematics({before.primary_shape, before.primary_gradient}, moved(x1),
                                                   {before.secondary_shape, before.secondary_gradient}, moved(x2));
    worst = std::max(worst, slip(past_point(after, x1, x2)).norm());
  });
  BOOST_TEST(worst <= 1e-12);
}

/// A tangent plane follows a rigid motion and a stretch; its normal component is dropped.
BOOST_AUTO_TEST_CASE(convection_turns_and_stretches_with_the_facet) {
  std::mt19937 random(4);
  for (const FacetType type : all_facets) {
    const FacetCoordinates past = random_facet(type, 0.05, random);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(2, random_vector(1, random).normalized()).toRotationMatrix();
    Facet facet;
    facet.type = type;
    for (Index corner = 0; corner < past.cols(); ++corner) {
      const FacetCoordinates c = convection(facet, corner, past).coefficients;
      const FacetGradient gradient = shape_functions(type, parametric_node(type, static_cast<int>(corner))).gradient;
      const Eigen::Matrix<double, 3, 2> tangents = past * gradient;
      const Vector3d normal = tangents.col(0).cross(tangents.col(1)).normalized();
      const Vector3d v = tangents * Vector2d(0.3, -0.8);
      const FacetCoordinates present = 1.5 * turn * past;
      const Eigen::Matrix3d carried = present * c.transpose();
      BOOST_TEST((carried * v - 1.5 * turn * v).norm() <= rounding);
      BOOST_TEST((carried * normal).norm() <= rounding);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_facet_without_area_carries_nothing) {
  Facet facet;
  facet.type = FacetType::tri3;
  const FacetCoordinates point = FacetCoordinates::Zero(3, 3);
  BOOST_TEST(convection(facet, 0, point).coefficients.norm() == 0.0);
}
