#include "contact/integration/facing_share.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

using namespace test;

namespace {

double share_at(double opposition) {
  return facing_share(Vector3d::UnitZ(), Vector3d(std::sqrt(1 - opposition * opposition), 0, -opposition));
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_corner_of_a_cube_counts_fully_and_a_leaning_side_does_not) {
  for (const double opposition : {1.0, std::sqrt(0.5), 1 / std::sqrt(3.0)}) BOOST_TEST(share_at(opposition) == 1);
  for (const double lean : {-0.3, 0.0, 1e-3, 0.1, 0.3, 0.5}) BOOST_TEST(share_at(std::sin(std::atan(lean))) == 0);
  BOOST_TEST(share_at(-1) == 0);
}

BOOST_AUTO_TEST_CASE(the_share_grows_smoothly) {
  constexpr double step = 1e-5;
  double last = 0;
  for (double opposition = 0.4; opposition < 0.6; opposition += step) {
    const double share = share_at(opposition);
    BOOST_TEST(share >= last);
    BOOST_TEST(share - last < 20 * step);
    last = share;
  }
  BOOST_TEST(last == 1);
}

BOOST_AUTO_TEST_CASE(the_share_varies_as_its_variation_says) {
  std::mt19937 random(3);
  for (const auto& [one, two] : facet_pairs()) {
    const GridSurface below = grid_surface({one, 1, 1}, 0);
    GridSurface above = grid_surface({two, 1, 1, {0, 0}, {1, 1}, 0, false}, 0);
    above.position = Eigen::AngleAxisd(std::acos(0.54), Vector3d(1, 2, 0).normalized()).toRotationMatrix() *
                     above.position;
    const FacetCoordinates x1 = facet_coordinates(below.mesh.facets[0], below.position);
    const FacetCoordinates x2 = facet_coordinates(above.mesh.facets[0], above.position);
    VectorXd nodes(x1.size() + x2.size());
    nodes << x1.reshaped(), x2.reshaped();
    nodes += random_values(nodes.size(), -0.003, 0.003, random);
    const auto share = [&](const VectorXd& at) -> VectorXd {
      const FacetCoordinates first = at.head(x1.size()).reshaped(3, x1.cols());
      const FacetCoordinates second = at.tail(x2.size()).reshaped(3, x2.cols());
      return VectorXd::Constant(1, facing_share(middle_normal(one, first), middle_normal(two, second)));
    };
    const double here = share(nodes)[0];
    BOOST_TEST_REQUIRE(here > 0);
    BOOST_TEST_REQUIRE(here < 1);
    const MatrixXd expected = fine_differences(share, nodes) / here;
    const PairVariation<1> found = facing_share_variation(one, nodes.head(x1.size()).reshaped(3, x1.cols()), two,
                                                          nodes.tail(x2.size()).reshaped(3, x2.cols()));
    BOOST_TEST((found - expected).norm() <= difference_tolerance * expected.norm());
  }
}
