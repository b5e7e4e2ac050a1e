#include "random_contact.h"

#include <boost/test/unit_test.hpp>

using namespace test;

BOOST_AUTO_TEST_CASE(every_tangent_block_matches_differences_for_every_pair_of_facets) {
  std::mt19937 random(1);
  double worst = 0;
  for (const FacetType one : all_facets) {
    for (const FacetType two : all_facets) {
      for (int sample = 0; sample < 20; ++sample) {
        const RandomContact contact(one, two, 3, random);
        const MatrixXd exact = contact.tangent(contact.unknowns);
        const MatrixXd approximate = differences([&](const VectorXd& q) { return contact.residual(q); }, contact.unknowns);
        worst = std::max(worst, (exact - approximate).norm() / exact.norm());
      }
    }
  }
  BOOST_TEST_MESSAGE("largest relative difference " << worst);
  BOOST_TEST(worst <= 1e-7);
}
