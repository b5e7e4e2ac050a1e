#include "contact/mortar/gap_changes.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

using namespace test;

/// One of two flat, parallel surfaces moves along the normal, each node by another distance: points do not move in the
/// projection along the normals, and gaps are linear in the distances.
BOOST_AUTO_TEST_CASE(changes_along_the_normals_of_flat_surfaces_are_those_of_the_gaps) {
  std::mt19937 random(7);
  for (const FacetType type : {FacetType::tri3, FacetType::quad4}) {
    Scene scene(facing_grids(type, FacetType::quad4, 0.05, 3, 4), effects_of(false, 0), explicit_settings(3, 2, 5));
    const auto contact = scene.contact();
    const MortarSpace& space = contact->pass(0).space();
    const VectorXd before = space.gaps().gap;
    PerSide<Matrix3Xd> moved;
    for (const Side side : both_sides) moved[side].setZero(3, scene.fields[side].position.cols());
    moved[Side::secondary].row(2) = random_values(moved[Side::secondary].cols(), -0.01, 0.01, random);
    NodeFlags nodes(before.size(), true);
    nodes[0] = false;
    const VectorXd changes = gap_changes(space, nodes, {moved[Side::primary], moved[Side::secondary]});
    scene.fields[Side::secondary].position += moved[Side::secondary];
    contact->project(scene.position());
    VectorXd expected = space.gaps().gap - before;
    BOOST_TEST(expected.cwiseAbs().minCoeff() > 1e6 * rounding);
    expected[0] = 0;
    BOOST_TEST((changes - expected).cwiseAbs().maxCoeff() < rounding);
  }
}

BOOST_AUTO_TEST_CASE(what_moves_both_surfaces_alike_changes_no_gap) {
  Scene scene(facing_grids(FacetType::tri3, FacetType::tri3, 0.05, 3, 4), effects_of(false, 0),
              explicit_settings(3, 2, 5));
  const auto contact = scene.contact();
  const MortarSpace& space = contact->pass(0).space();
  PerSide<Matrix3Xd> moved;
  for (const Side side : both_sides)
    moved[side] = Vector3d(0.3, -0.1, 0.2).replicate(1, scene.fields[side].position.cols());
  const NodeFlags all(space.nodes(), true);
  const VectorXd changes = gap_changes(space, all, {moved[Side::primary], moved[Side::secondary]});
  BOOST_TEST(changes.cwiseAbs().maxCoeff() < rounding);
}
