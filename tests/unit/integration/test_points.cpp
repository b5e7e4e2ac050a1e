#include "contact/integration/points.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

using namespace test;

namespace {

/// Two squares with four Gauss points. The upper one may be shifted along x.
struct Squares {
  PerSide<Grid> grids = facing_grids(FacetType::quad4, FacetType::quad4, 0.1, 1, 1);
  GridSurface below = grid_surface(grids[Side::primary], 0);
  GridSurface above = grid_surface(grids[Side::secondary], 0);
  GaussPoints points{below.mesh.facets, 0, 0.01};

  FacingFacets facets() const { return {below.mesh.facets, above.mesh.facets}; }

  Matrix3Xd shifted(double by) const {
    Matrix3Xd position = above.position;
    position.row(0).array() += by;
    return position;
  }

  /// Parametric coordinates of the projected points along x. The upper square faces downwards, so that its coordinate
  /// runs backwards.
  std::vector<double> seen(double shift) {
    std::vector<double> places;
    const FacetPairs found = points.search(facets(), {below.position, shifted(shift)}, 1);
    for (const IntegrationPoint& point : found.points()) places.push_back(-point.eta[0]);
    std::sort(places.begin(), places.end());
    return places;
  }
};

constexpr double half = 0.5;  // of a square: shift at which its first two points lose the other square

}  // namespace

BOOST_AUTO_TEST_CASE(a_point_whose_projection_is_lost_twice_in_a_step_is_kept_beyond_the_edge) {
  Squares squares;
  for (int loss = 1; loss <= 2; ++loss) {
    BOOST_TEST(squares.seen(0).size() == 4);
    BOOST_TEST(!squares.points.keep_lost_points());
    BOOST_TEST(squares.seen(half).size() == 2);
    BOOST_TEST(squares.points.keep_lost_points() == (loss == 2));
  }
  const double place = 1 / std::sqrt(3.0);
  const std::vector<double> kept = squares.seen(half);
  BOOST_TEST(kept.size() == 4);
  BOOST_TEST(std::abs(kept.front() + place + 1) <= rounding);  // half a square is a parametric coordinate of 1
  BOOST_TEST(std::abs(kept.back() - place + 1) <= rounding);
  const auto same = squares.points.on_same_facets(squares.facets(), {squares.below.position, squares.shifted(half)});
  BOOST_TEST(same.pairs().front().points == 4);
  BOOST_TEST(!squares.points.keep_lost_points());
  BOOST_TEST(squares.seen(0.75).size() == 2);  // points more than half a square beyond the edge are lost
  squares.points.end_iterations();
  BOOST_TEST(squares.seen(half).size() == 2);
}

BOOST_AUTO_TEST_CASE(points_that_pass_an_edge_once_are_let_go) {
  Squares squares;
  for (const double shift : {0.0, half, half, half}) {
    squares.seen(shift);
    BOOST_TEST(!squares.points.keep_lost_points());
  }
  BOOST_TEST(squares.seen(half).size() == 2);
}

BOOST_AUTO_TEST_CASE(the_motion_of_a_step_extends_the_search_for_overlaps_alone) {
  Reach reach = 1;
  reach.beyond = 1;
  for (const double overlap : {-1.5, 1.5}) {
    const PerSide<Grid> grids = facing_grids(FacetType::quad4, FacetType::quad4, overlap, 1, 1);
    const GridSurface below = grid_surface(grids[Side::primary], 0);
    const GridSurface above = grid_surface(grids[Side::secondary], 0);
    const FacingFacets facets{below.mesh.facets, above.mesh.facets};
    GaussPoints finder(below.mesh.facets, 3, 0.01);
    BOOST_TEST(finder.search(facets, {below.position, above.position}, 1).pairs().empty());
    BOOST_TEST(finder.search(facets, {below.position, above.position}, reach).pairs().empty() == (overlap < 0));
  }
}

BOOST_AUTO_TEST_CASE(points_of_a_pair_lie_together_in_whatever_order_they_are_found) {
  // Nine points of a square, row by row, face two by two squares.
  const PerSide<Grid> grids = facing_grids(FacetType::quad4, FacetType::quad4, 0.1, 1, 2);
  const GridSurface below = grid_surface(grids[Side::primary], 0);
  const GridSurface above = grid_surface(grids[Side::secondary], 0);
  const FacingFacets facets{below.mesh.facets, above.mesh.facets};
  GaussPoints finder(below.mesh.facets, 3, 0.01);
  const FacetPairs found = finder.search(facets, {below.position, above.position}, 1);
  BOOST_TEST(found.pairs().size() == 4);
  BOOST_TEST(found.points().size() == 9);
  Index first = 0;
  for (const FacetPair& pair : found.pairs()) {
    BOOST_TEST(pair.first == first);
    BOOST_TEST(pair.points > 0);
    first += pair.points;
    const Facet& one = below.mesh.facets[pair.primary];
    const Facet& two = above.mesh.facets[pair.secondary];
    for (const IntegrationPoint& point : found.points(pair)) {
      const Vector3d x1 = facet_coordinates(one, below.position) * shape_functions(one.type, point.xi).value;
      const Vector3d x2 = facet_coordinates(two, above.position) * shape_functions(two.type, point.eta).value;
      BOOST_TEST((x1 - x2).head<2>().norm() <= rounding);
    }
  }
  BOOST_TEST(first == 9);
}

BOOST_AUTO_TEST_CASE(pairs_are_added_and_the_last_one_is_removed_with_its_points) {
  const auto at = [](double xi) { return IntegrationPoint{{xi, 0}, {0, 0}, 1, 0}; };
  FacetPairs pairs;
  pairs.add_pair(3, 7);
  pairs.add_point(at(1));
  pairs.add_pair(3, 8);
  pairs.add_point(at(2));
  pairs.add_point(at(3));
  pairs.remove_last_pair();
  pairs.add_pair(4, 9);
  pairs.add_point(at(4));
  FacetPairs others;
  others.add(pairs, pairs.pairs().back());
  others.add(pairs, pairs.pairs().front());
  BOOST_TEST(pairs.points().size() == 2);
  BOOST_TEST(others.pairs()[0].secondary == 9);
  BOOST_TEST(others.points(others.pairs()[0])[0].xi[0] == 4);
  BOOST_TEST(others.pairs()[1].primary == 3);
  BOOST_TEST(others.points(others.pairs()[1])[0].xi[0] == 1);
  BOOST_TEST(others.pairs()[1].first == 1);
  pairs.clear();
  BOOST_TEST((pairs.pairs().empty() && pairs.points().empty()));
}
