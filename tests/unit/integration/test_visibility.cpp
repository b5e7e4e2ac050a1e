#include "contact/integration/visibility.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <set>

using namespace test;

namespace {

/// A plate over the unit square.
struct Plate {
  double bottom;
  double top;
  int cells;
};

/// The upper and lower side of a plate as one surface. `top_first`: whether the facets of the upper side come first.
GridSurface both_sides_of(FacetType type, const Plate& plate, bool top_first) {
  const Grid upper{type, plate.cells, plate.cells, {0, 0}, {1, 1}, plate.top, true};
  const Grid lower{type, plate.cells, plate.cells, {0, 0}, {1, 1}, plate.bottom, false};
  GridSurface both = grid_surface(top_first ? upper : lower, 0);
  const GridSurface second = grid_surface(top_first ? lower : upper, 0);
  for (Facet facet : second.mesh.facets) {
    for (int& node : facet.nodes) node += both.mesh.nodes;
    both.mesh.facets.push_back(facet);
  }
  both.mesh.nodes += second.mesh.nodes;
  const Matrix3Xd first = both.position;
  both.position.resize(3, both.mesh.nodes);
  both.position << first, second.position;
  both.mesh.permeable.assign(both.mesh.facets.size(), ~FieldMask{0});
  both.mesh.stiffness = VectorXd::Ones(both.mesh.facets.count());
  both.mesh.conductance.resize(0, both.mesh.facets.count());
  return both;
}

/// Two plates on top of each other, each with all its sides as one surface. The touching sides come first.
Scene plates(FacetType type, Integration integration, const Plate& upper, const Plate& lower) {
  Settings settings = explicit_settings(4, 2, 8);
  settings.integration = integration;
  Scene scene(facing_grids(type, type, 0), effects_of(false, 0), settings);
  const PerSide<GridSurface> both{{both_sides_of(type, upper, false), both_sides_of(type, lower, true)}};
  for (const Side side : both_sides) {
    scene.mesh[side] = both[side].mesh;
    scene.fields[side] = {both[side].position, MatrixXd::Zero(both[side].mesh.nodes, 0)};
  }
  return scene;
}

constexpr Plate above{-0.01, 0.24, 2};
constexpr Plate below{-0.25, 0, 3};

/// True if the touching sides of two plates are paired, and no others.
bool touching_sides_alone(const Scene& scene) {
  std::set<int> paired;
  const auto contact = scene.contact();
  for (const FacetPair& pair : contact->pass(0).pairs()) paired.insert(pair.primary);
  const int touching = static_cast<int>(scene.mesh[Side::primary].facets.count()) / 2;
  return static_cast<int>(paired.size()) == touching && *paired.rbegin() < touching;
}

}  // namespace

BOOST_AUTO_TEST_CASE(far_sides_of_two_layers_do_not_see_each_other) {
  for (const FacetType type : all_facets) {
    for (const Integration integration : {Integration::gauss, Integration::segments})
      BOOST_TEST(touching_sides_alone(plates(type, integration, above, below)));
  }
}

BOOST_AUTO_TEST_CASE(a_layer_may_go_as_deep_as_three_quarters_of_its_thickness) {
  for (const Integration integration : {Integration::gauss, Integration::segments}) {
    BOOST_TEST(touching_sides_alone(plates(FacetType::quad4, integration, {-0.07, 0.03, 2}, {-1, 0, 3})));
    BOOST_TEST(touching_sides_alone(plates(FacetType::quad4, integration, {-0.07, 0.93, 2}, {-0.1, 0, 3})));
  }
}

BOOST_AUTO_TEST_CASE(nodes_of_far_sides_face_nothing) {
  const Scene scene = plates(FacetType::quad4, Integration::segments, above, below);
  const auto contact = scene.contact();
  contact->begin_iteration(scene.fields);
  const NodeFlags faced = contact->nodes_in_contact()[Side::secondary];
  for (Index node = 0; node < faced.count(); ++node) BOOST_TEST(faced[node] == (node < faced.count() / 2));
  BOOST_TEST(contact->check_penetration(scene.fields).nodes == 0);
}

BOOST_AUTO_TEST_CASE(nodes_of_the_far_side_are_not_inside_a_shell) {
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0), effects_of(false, 0), explicit_settings(4, 2, 8));
  const GridSurface shell = grid_surface({FacetType::quad4, 2, 2, {0, 0}, {1, 1}, 0.01, true}, 0);
  const GridSurface bone = both_sides_of(FacetType::quad4, below, true);
  const PerSide<GridSurface> both{{shell, bone}};
  for (const Side side : both_sides) {
    scene.mesh[side] = both[side].mesh;
    scene.fields[side] = {both[side].position, MatrixXd::Zero(both[side].mesh.nodes, 0)};
  }
  const auto contact = scene.contact();
  contact->begin_iteration(scene.fields);
  BOOST_TEST(contact->check_penetration(scene.fields).nodes == 0);
}

BOOST_AUTO_TEST_CASE(a_body_ahead_hides_what_lies_behind_it) {
  const GridSurface own = both_sides_of(FacetType::quad4, {1, 1.25, 1}, false);
  const GridSurface other = grid_surface({FacetType::quad4, 1, 1, {0, 0}, {1, 1}, 2, false}, 0);
  Visibility visibility(own.mesh, other.mesh);
  visibility.move_to(own.position, other.position);
  const Vector3d up = Vector3d::UnitZ();
  BOOST_TEST(visibility.is_hidden({0.3, 0.4, 0}, up, 2, Visibility::node, 0));
  BOOST_TEST(!visibility.is_hidden({0.3, 0.4, 1.5}, up, 0.5, Visibility::node, 0));
}

BOOST_AUTO_TEST_CASE(shallow_overlaps_are_not_looked_at) {
  GridSurface own = both_sides_of(FacetType::quad4, {0, 0.25, 1}, false);
  GridSurface other = both_sides_of(FacetType::quad4, {0, 0.5, 1}, true);
  const Vector3d down = -Vector3d::UnitZ();
  for (const bool is_known : {false, true}) {
    if (is_known) own.mesh.thickness = other.mesh.thickness = VectorXd::Constant(2, 0.8);
    Visibility visibility(own.mesh, other.mesh);
    visibility.move_to(own.position, other.position);
    BOOST_TEST(visibility.is_hidden({0.3, 0.4, 0}, down, -0.39, 0, 0) != is_known);
    BOOST_TEST(visibility.is_hidden({0.3, 0.4, 0}, down, -0.45, 0, 0));
  }
}
