/// Tests of averages over the pairs around nodes: moments of flat pairs give the same averages as points.
#include "contact/mortar/mortar_space.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

using namespace test;

namespace {

/// A flat scene that exchanges a field, with the averages over its pairs.
struct FlatScene : Scene {
  FlatScene()
      : Scene(flat_scene(effects_of(true, 0))), space(mesh[Side::primary], mesh[Side::secondary], effects, settings) {
    space.change_facing().search({fields[Side::primary].position, fields[Side::secondary].position}, 1);
  }

  FacingFields facing() const { return seen_from(Side::primary, fields); }
  PointKinematics kinematics(const FacetPair& pair, const IntegrationPoint& place) const {
    const Facet& one = space.facing().primary_facet(pair);
    const Facet& two = space.facing().secondary_facet(pair);
    return point_kinematics(shape_functions(one.type, place.xi), facet_coordinates(one, facing().primary.position),
                            shape_functions(two.type, place.eta), facet_coordinates(two, facing().secondary.position));
  }
  /// Sums of 1, of gaps and of jumps over the points of all pairs, weighted with the functions of the space.
  Matrix3Xd sums_of_points() const {
    Matrix3Xd sums = Matrix3Xd::Zero(3, space.nodes());
    for (const FacetPair& pair : space.facing().pairs()) {
      for (const IntegrationPoint& place : space.facing().points(pair)) {
        const PointKinematics point = kinematics(pair, place);
        const FacetVector psi = space.shape(pair.primary, place.sub_facet, place.xi).value;
        const double jump = point.jump_weights().dot(space.facing().values(pair, 0, facing()));
        for (Index a = 0; a < psi.size(); ++a)
          sums.col(space.facing().primary_facet(pair).node(a)) += place.weight * point.area * psi[a] *
                                                                  Vector3d(1, point.gap, jump);
      }
    }
    return sums;
  }

  MortarSpace space;
};

}  // namespace

BOOST_AUTO_TEST_CASE(flat_pairs_average_as_their_points_do) {
  for (const bool redistributes : {false, true}) {
    FlatScene scene;
    if (redistributes) {
      FacetGapSums covered = FacetGapSums::Zero(2, 3);
      covered.row(0) << 1, 1, 0.1;  // the covered part is too small for the last node to carry load
      scene.space.boundary_weights().decide(0, covered, FacetVector::Ones(3));
    }
    BOOST_TEST(scene.space.boundary_weights().heirs(0, FacetType::tri3).has_value() == redistributes);
    const IndexedVector<FacetPair>& pairs = scene.space.facing().pairs();
    BOOST_TEST(std::all_of(pairs.begin(), pairs.end(),
                           [&](const FacetPair& pair) { return scene.space.facing().flat(pair) != nullptr; }));

    const NodeFlags all(scene.space.nodes(), true);
    const NodalLoads loads = scene.space.averages(scene.space.gaps(), scene.facing(), {all, all, {}});
    const Matrix3Xd sums = scene.sums_of_points();
    const VectorXd area = sums.row(0);
    BOOST_TEST((loads.area - area).cwiseAbs().maxCoeff() <= rounding);
    BOOST_TEST((loads.gap - (sums.row(1).transpose().cwiseQuotient(area))).cwiseAbs().maxCoeff() <= rounding);
    const VectorXd jump = loads.jump.row(0);
    BOOST_TEST((jump - sums.row(2).transpose().cwiseQuotient(area)).cwiseAbs().maxCoeff() <= rounding);
  }
}

BOOST_AUTO_TEST_CASE(nodes_of_an_edge_average_over_the_side_that_is_faced_best) {
  constexpr double overlap = 0.01;
  for (const Integration integration : {Integration::gauss, Integration::segments}) {
    for (const double turned : {50.0, 58.0}) {  // rotation of one half of a strip in degrees
      Settings settings = explicit_settings(4, 2, 8);
      settings.integration = integration;
      const Grid strip{FacetType::quad4, 4, 1, {-1, 0}, {1, 1}};
      const Grid plane{FacetType::quad4, 1, 1, {-3, -3}, {3, 3}, -overlap, false};
      const PerSide<Grid> grids{{strip, plane}};
      Scene scene(grids, effects_of(false, 0), settings);
      const double angle = turned / 180 * 3.14159265358979;
      for (auto x : scene.fields[Side::primary].position.colwise()) {
        if (x[0] > 0) x = Vector3d(x[0] * std::cos(angle), x[1], -x[0] * std::sin(angle));
      }
      const auto contact = scene.contact();
      const VectorXd& gap = contact->pass(0).space().gaps().gap;
      for (Index node = 0; node < gap.size(); ++node) {
        if (scene.fields[Side::primary].position.col(node)[0] != 0) continue;
        BOOST_TEST((std::abs(gap[node] + overlap) <= 1e-12) == (turned > 53));
      }
    }
  }
}
