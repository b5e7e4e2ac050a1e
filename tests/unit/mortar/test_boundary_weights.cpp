#include "mortar/boundary_weights.h"

#include <boost/test/unit_test.hpp>

using namespace mixture_contact;

namespace {

const IndexedVector<Facet> one_square{Facet{FacetType::quad4, {0, 1, 2, 3}}};
constexpr int square = 0;

/// INT psi_a da over a unit square, per node.
FacetVector shares() { return FacetVector::Constant(4, 0.25); }

/// Integrals if the other surface covers a unit square from x = 0 to s at a distance g: near nodes are covered to 2s -
/// s^2 of their area, far nodes to s^2.
FacetGapSums covered(double s, double g = 0) {
  FacetGapSums sums(2, 4);
  const double near = 0.25 * (2 * s - s * s);
  const double far = 0.25 * s * s;
  sums.row(0) << near, far, far, near;
  sums.row(1) = g * sums.row(0);
  return sums;
}

/// True if the far nodes carry load after the other surface has covered these fractions of the facet in successive
/// steps.
bool far_nodes_carry(std::initializer_list<double> parts) {
  BoundaryWeights weights(1);
  for (const double s : parts) {
    weights.settle();
    weights.decide(square, covered(s), shares());
  }
  return weights.last_decisions()[square][1] > 0;
}

}  // namespace

BOOST_AUTO_TEST_CASE(far_nodes_carry_load_from_a_coverage_of_0_82_on) {
  // The equation s^2 = 0.7 (2s - s^2) has the solution s = 1.4/1.7.
  BOOST_TEST(!far_nodes_carry({1.4 / 1.7 - 1e-6}));
  BOOST_TEST(far_nodes_carry({1.4 / 1.7 + 1e-6}));
}

BOOST_AUTO_TEST_CASE(decisions_hold_over_steps_until_they_are_clearly_wrong) {
  // The equation s^2 = r (2s - s^2) has the solution s = 2r/(1 + r): 1/2 for r = 1/3, and 1.9/1.95 for r = 0.95.
  BOOST_TEST(far_nodes_carry({1, 0.5 + 1e-6}));
  BOOST_TEST(!far_nodes_carry({1, 0.5 - 1e-6}));
  BOOST_TEST(!far_nodes_carry({0.1, 1.9 / 1.95 - 1e-6}));
  BOOST_TEST(far_nodes_carry({0.1, 1.9 / 1.95 + 1e-6}));
  BOOST_TEST(far_nodes_carry({0.1, 1, 0.6, 0.8}));
}

BOOST_AUTO_TEST_CASE(a_decision_made_again_in_the_same_place_is_the_same) {
  for (const double before : {0.1, 1.0}) {
    for (const double s : {0.2, 0.6, 0.75, 0.9, 0.97}) {
      BOOST_TEST(far_nodes_carry({before, s}) == far_nodes_carry({before, s, s}));
    }
  }
}

BOOST_AUTO_TEST_CASE(reconsidering_starts_from_the_settled_decision) {
  BoundaryWeights weights(1);
  weights.decide(square, covered(1), shares());
  weights.settle();
  weights.decide(square, covered(0.1), shares());
  weights.reconsider();
  BOOST_TEST(!weights.knows(square));
  weights.decide(square, covered(0.75), shares());
  BOOST_TEST(weights.last_decisions()[square].minCoeff() == 1);
}

BOOST_AUTO_TEST_CASE(stored_decisions_continue_where_they_were_made) {
  BoundaryWeights weights(1);
  weights.decide(square, covered(1), shares());
  BoundaryWeights fresh(1);
  fresh.restore(weights.last_decisions());
  fresh.decide(square, covered(0.75), shares());
  BOOST_TEST(fresh.last_decisions()[square].minCoeff() == 1);
}

BOOST_AUTO_TEST_CASE(nodes_away_from_the_other_surface_have_no_load_to_give) {
  BoundaryWeights weights(1);
  weights.decide(square, covered(0.5, 0.011), shares());
  BOOST_TEST(weights.last_decisions()[square].minCoeff() == 1);
  weights.reconsider();
  weights.decide(square, covered(0.5, 0.009), shares());
  BOOST_TEST(weights.last_decisions()[square].minCoeff() == 0);
}
