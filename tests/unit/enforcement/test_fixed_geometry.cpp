// Tests of surfaces that cannot move: their contact is linear transport, with the same results as for surfaces that can
// move.
#include "surfaces.h"

#include <boost/test/unit_test.hpp>

namespace {

using namespace test;

constexpr double dt = 0.5;

/// Overlapping, disturbed surfaces with random fields, with or without exchange of traction.
Scene overlapping(FacetType one, FacetType two, Settings settings = {}) {
  std::mt19937 random(1);
  Scene scene(facing_grids(one, two, 0.2, 3, 2), effects_of(true, 2), settings);
  scene.disturb(0.03, random);
  return scene;
}

Scene with_fixed_geometry(Scene scene) {
  scene.effects.traction = false;
  return scene;
}

/// Entries of all fields at all nodes in the global layout.
std::vector<Index> field_entries(const GlobalLayout& layout) {
  std::vector<Index> entries;
  for (const Side side : both_sides) {
    for (Index node = 0; node < layout.nodes[side]; ++node) {
      for (Index k = 0; k < layout.fields; ++k) entries.push_back(layout.entry(side, node, 3 + k));
    }
  }
  return entries;
}

}  // namespace

BOOST_AUTO_TEST_CASE(fluxes_are_those_of_surfaces_that_could_move) {
  for (const FacetType one : {FacetType::quad4, FacetType::tri6, FacetType::quad8}) {
    for (const bool two_pass : {false, true}) {
      Settings settings;
      settings.two_pass = two_pass;
      const Scene scene = overlapping(one, FacetType::tri3, settings);
      const GlobalLayout layout(scene);
      const std::vector<Index> fields = field_entries(layout);
      const auto moving = scene.contact();
      const auto fixed = with_fixed_geometry(scene).contact();
      const VectorXd expected = assembled_residual(*moving, layout, scene.fields, dt);
      const VectorXd residual = assembled_residual(*fixed, layout, scene.fields, dt);
      BOOST_TEST(VectorXd(expected(fields)).norm() > 0);
      BOOST_TEST(relative_error(residual(fields), expected(fields)) <= rounding);
      const MatrixXd slope = assembled_tangent(*moving, layout, scene.fields, dt);
      const MatrixXd tangent = assembled_tangent(*fixed, layout, scene.fields, dt);
      BOOST_TEST(relative_error(tangent(fields, fields), slope(fields, fields)) <= rounding);
      BOOST_TEST(std::abs(tangent.norm() - MatrixXd(tangent(fields, fields)).norm()) <= rounding * tangent.norm());
      BOOST_TEST((moving->nodes_in_contact() == fixed->nodes_in_contact()));
    }
  }
}

BOOST_AUTO_TEST_CASE(nothing_of_displacements_is_handed_out) {
  const Scene scene = with_fixed_geometry(overlapping(FacetType::quad4, FacetType::tri3));
  const auto contact = scene.contact();
  const auto is_free_of_them = [](const ContactInterface::Location& at) {
    return !at.patch.displacements && at.patch.layout().per_node() == static_cast<Index>(at.patch.fields.size());
  };
  int calls = 0;
  contact->residual(scene.fields, dt,
                    [&](const auto& at, const VectorXd&) { calls += is_free_of_them(at) ? 1 : -999; });
  contact->tangent(scene.fields, dt, [&](const auto& rows, const auto& columns, const MatrixXd&) {
    calls += is_free_of_them(rows) && is_free_of_them(columns) ? 1 : -999;
  });
  contact->for_each_coupling([&](const auto& at) { calls += is_free_of_them(at) ? 1 : -999; });
  BOOST_TEST(calls > 0);
  BOOST_TEST(output(*contact, scene.fields).balance.force.norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(surfaces_that_just_touch_exchange_and_those_apart_do_not) {
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0), effects_of(true, 0), explicit_settings(0, 2, 1));
  scene.effects.traction = false;
  scene.set_field(0, 1, 0);
  const auto flow_at = [&](double distance) {
    scene.fields[Side::secondary].position.row(2).setConstant(distance);
    const auto contact = scene.contact();
    BOOST_TEST(!contact->begin_iteration(scene.fields));
    return output(*contact, scene.fields).balance.flow[0];
  };
  BOOST_TEST(std::abs(flow_at(0) - 2) <= rounding);
  BOOST_TEST(std::abs(flow_at(-1e-3) - 2) <= rounding);
  BOOST_TEST(flow_at(1e-3) == 0.0);
}

BOOST_AUTO_TEST_CASE(traction_comes_back_when_surfaces_are_freed) {
  const Scene scene = overlapping(FacetType::quad8, FacetType::quad4);
  const GlobalLayout layout(scene);
  const auto contact = with_fixed_geometry(scene).contact();
  contact->begin_iteration(scene.fields);
  contact->augment(scene.fields);
  const auto fresh = scene.contact();
  fresh->pass(0).laws().multipliers = contact->pass(0).laws().multipliers;
  BOOST_TEST(fresh->pass(0).laws().multipliers.traction.norm() == 0.0);
  contact->exchange_traction(true);
  contact->project(scene.position());
  BOOST_TEST(
      (assembled_residual(*contact, layout, scene.fields, dt) == assembled_residual(*fresh, layout, scene.fields, dt)));
}

BOOST_AUTO_TEST_CASE(unknown_multipliers_of_fluxes_have_an_exact_tangent) {
  Settings settings;
  settings.enforcement = Enforcement::lagrange_multipliers;
  Scene scene = with_fixed_geometry(overlapping(FacetType::quad4, FacetType::tri3, settings));
  const GlobalLayout layout(scene);
  const auto contact = scene.contact();
  BOOST_TEST(layout.multipliers.size() == layout.nodes[Side::primary] * layout.fields);
  const auto residual = [&](const VectorXd& q) {
    set_unknown_multipliers(*contact, q.tail(layout.multipliers.size()));
    PerSide<SurfaceFields> fields = layout.unpack(q.head(layout.nodal_size()));
    for (const Side side : both_sides) fields[side].position = scene.fields[side].position;
    return assembled_residual(*contact, layout, fields, dt);
  };
  VectorXd q(layout.size());
  q << layout.pack(scene.fields), VectorXd::LinSpaced(layout.multipliers.size(), -1, 1);
  residual(q);
  const MatrixXd tangent = assembled_tangent(*contact, layout, scene.fields, dt);
  BOOST_TEST(relative_error(tangent, differences(residual, q)) <= difference_tolerance);
}
