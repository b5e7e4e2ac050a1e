#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

using namespace test;

/// The residual of a whole contact at constant contact status is differentiated with respect to all unknowns.
BOOST_AUTO_TEST_CASE(the_assembled_tangent_matches_differences_for_every_pair_of_meshes) {
  std::mt19937 random(7);
  double worst = 0;
  for (const auto& [one, two] : facet_pairs()) {
    for (const bool two_pass : {false, true}) {
      Settings settings = explicit_settings(2.5, 1.5, 0.8);
      settings.two_pass = two_pass;
      Scene scene(facing_grids(one, two, 0.08, 1, 2), effects_of(true, 1), settings);
      scene.disturb(0.02, random);
      const auto contact = scene.contact();
      accept_any_load(*contact);
      contact->begin_iteration(scene.fields);
      const GlobalLayout layout(scene);
      const VectorXd q = layout.pack(scene.fields);
      const auto residual = [&](const VectorXd& at) {
        const PerSide<SurfaceFields> fields = layout.unpack(at);
        contact->project({{fields[Side::primary].position, fields[Side::secondary].position}});
        return assembled_residual(*contact, layout, fields, 0.3);
      };
      const MatrixXd approximate = differences(residual, q);
      contact->project(scene.position());
      const MatrixXd exact = assembled_tangent(*contact, layout, scene.fields, 0.3);
      const double difference = (exact - approximate).norm() / exact.norm();
      BOOST_TEST_MESSAGE(static_cast<int>(one)
                         << " " << static_cast<int>(two) << " " << two_pass << ": " << difference);
      worst = std::max(worst, difference);
    }
  }
  BOOST_TEST_MESSAGE("largest relative difference " << worst);
  BOOST_TEST(worst <= 1e-7);
}

/// An iteration that is moved to another state keeps its contact status and measures its loads there.
BOOST_AUTO_TEST_CASE(a_moved_iteration_keeps_its_status_and_measures_anew) {
  std::mt19937 random(11);
  Scene scene(facing_grids(FacetType::quad4, FacetType::tri3, 0.08, 2, 3), effects_of(true, 1),
              looking_as_far_as(1, explicit_settings(2.5, 1.5, 0.8)));
  scene.disturb(0.02, random);
  const auto moved = scene.contact();
  moved->begin_iteration(scene.fields);
  moved->hold_nodes_in_contact();
  scene.disturb(0.02, random);
  const GlobalLayout layout(scene);
  moved->project(scene.position());
  moved->linearise_at(scene.fields);

  const auto started = scene.contact();
  started->begin_iteration(scene.fields);
  const VectorXd expected = assembled_residual(*started, layout, scene.fields, 0.3);
  BOOST_TEST(relative_error(assembled_residual(*moved, layout, scene.fields, 0.3), expected) <= rounding);

  // The surfaces are 0.2 apart: a new iteration would find no contact.
  for (Index node = 0; node < scene.fields[Side::secondary].position.cols(); ++node)
    scene.fields[Side::secondary].position(2, node) += 0.3;
  moved->project(scene.position());
  moved->linearise_at(scene.fields);
  const PerSide<NodeFlags> status = moved->nodes_in_contact();
  BOOST_TEST(std::count(status[Side::primary].begin(), status[Side::primary].end(), false) == 0);
  const double force = output(*moved, scene.fields).balance.force[2];
  BOOST_TEST(std::abs(force) > 0.1);
  started->project(scene.position());
  started->end_iterations();
  BOOST_TEST(std::abs(output(*started, scene.fields).balance.force[2]) == 0.0);
}

/// Nodes that overlap in the other state are in contact there, with their loads at that state.
BOOST_AUTO_TEST_CASE(nodes_that_overlap_where_an_iteration_is_moved_to_close) {
  Scene scene(facing_grids(FacetType::quad4, FacetType::tri3, -0.05, 2, 3), effects_of(true, 1),
              explicit_settings(2.5, 1.5, 0.8));
  const auto moved = scene.contact();
  moved->begin_iteration(scene.fields);
  BOOST_TEST(output(*moved, scene.fields).balance.force[2] == 0.0);
  scene.fields[Side::secondary].position.row(2).array() -= 0.1;
  moved->project(scene.position());
  moved->linearise_at(scene.fields);
  for (const Side side : both_sides) {
    const std::vector<bool> closed = moved->hold_nodes_in_contact()[side];
    BOOST_TEST(std::count(closed.begin(), closed.end(), false) == 0);
  }
  const GlobalLayout layout(scene);
  const VectorXd expected = assembled_residual(*scene.contact(), layout, scene.fields, 0.3);
  BOOST_TEST(expected.norm() > 0.0);
  BOOST_TEST(relative_error(assembled_residual(*moved, layout, scene.fields, 0.3), expected) <= rounding);
}

/// Two squares of side h = 1 under the traction t = penalty * g tilt together: their nodes move by a (1 - 2x) along the
/// normal. The gaps remain, but the intersections with the normals move by 2 a g/h. The loads of the secondary surface
/// therefore differ by 4 t g a/h between its two edges, along its tilt. Two passes have such loads on both surfaces.
BOOST_AUTO_TEST_CASE(surfaces_that_rays_meet_are_pushed_the_way_both_tilt) {
  for (const bool two_pass : {false, true}) {
    const double penalty = 2.5;
    const double overlap = 0.25;
    Settings settings = explicit_settings(penalty, 1.5, 0.8);
    settings.two_pass = two_pass;
    const Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, overlap, 1, 1), effects_of(false, 0), settings);
    const auto contact = scene.contact();
    accept_any_load(*contact);
    contact->begin_iteration(scene.fields);
    const GlobalLayout layout(scene);
    PerSide<VectorXd> tilt;
    for (const Side side : both_sides) {
      tilt[side] = VectorXd::Zero(layout.size());
      for (Index node = 0; node < 4; ++node)
        tilt[side][layout.entry(side, node, 2)] = 1 - 2 * scene.fields[side].position(0, node);
    }
    const VectorXd change = assembled_tangent(*contact, layout, scene.fields, 1) *
                            (tilt[Side::primary] + tilt[Side::secondary]);
    const double pushed = 4 * penalty * overlap * overlap;
    BOOST_TEST(std::abs(tilt[Side::secondary].dot(change) - pushed) <= rounding);
    BOOST_TEST(std::abs(tilt[Side::primary].dot(change) - (two_pass ? pushed : 0)) <= rounding);
  }
}

/// An augmentation doubles the loads until the gaps are closed. The tangent remains that of the equilibrium before.
BOOST_AUTO_TEST_CASE(an_augmentation_leaves_the_tangent_as_it_is) {
  std::mt19937 random(13);
  Settings settings = explicit_settings(2.5, 1.5, 0.8);
  settings.tolerances.traction.relative = settings.tolerances.solvent.relative = settings.tolerances.solute
                                                                                     .relative = 0;
  Scene scene(facing_grids(FacetType::quad4, FacetType::tri3, 0.08, 2, 3), effects_of(true, 1), settings);
  scene.disturb(0.02, random);
  const auto contact = scene.contact();
  const GlobalLayout layout(scene);
  accept_any_load(*contact);
  contact->begin_iteration(scene.fields);
  const MatrixXd before = assembled_tangent(*contact, layout, scene.fields, 0.3);
  const VectorXd load = assembled_residual(*contact, layout, scene.fields, 0.3);
  contact->augment(scene.fields);
  contact->end_iterations();
  contact->begin_iteration(scene.fields);
  BOOST_TEST(relative_error(assembled_tangent(*contact, layout, scene.fields, 0.3), before) <= rounding);
  BOOST_TEST(relative_error(assembled_residual(*contact, layout, scene.fields, 0.3), VectorXd(2 * load)) <= rounding);
}

/// At the start of a step, a jump at nodes that were not flux-coupled at the end of the last step does not come from
/// fluxes: times a large penalty, it would be a large error of the tangent. A uniform jump varies with the fields only,
/// so that the result is the tangent without a jump.
BOOST_AUTO_TEST_CASE(a_step_begins_without_fluxes_at_nodes_that_were_not_flux_coupled) {
  std::mt19937 random(18);
  Scene scene(facing_grids(FacetType::quad4, FacetType::tri3, 0.08, 1, 2), effects_of(true, 1),
              explicit_settings(2.5, 1.5, 0.8));
  scene.disturb(0.02, random);
  const auto contact = scene.contact();
  const auto tangent_where = [&](bool flux_coupled, double jump) {
    scene.fields[Side::primary].scalar.setConstant(jump);
    scene.fields[Side::secondary].scalar.setZero();
    contact->pass(0).laws().multipliers.flux_coupled = NodeFlags(scene.mesh[Side::primary].nodes, flux_coupled);
    contact->end_iterations();
    contact->begin_iteration(scene.fields);
    return assembled_tangent(*contact, GlobalLayout(scene), scene.fields, 0.3);
  };
  const MatrixXd without = tangent_where(true, 0);
  BOOST_TEST((tangent_where(false, 2) - without).norm() <= rounding * without.norm());
  BOOST_TEST((tangent_where(true, 2) - without).norm() > 0.01 * without.norm());
}

/// An accepted step leaves its status in the state of the contact.
BOOST_AUTO_TEST_CASE(an_accepted_step_remembers_which_nodes_were_flux_coupled) {
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.08, 1, 1), effects_of(true, 0),
              explicit_settings(2.5, 1.5, 0.8));
  const auto contact = scene.contact();
  const NodeFlags& flux_coupled = contact->pass(0).laws().multipliers.flux_coupled;
  BOOST_TEST((flux_coupled == NodeFlags(4, false)));
  contact->begin_iteration(scene.fields);
  contact->accept_step(scene.fields);
  BOOST_TEST((flux_coupled == NodeFlags(4, true)));
  const ContactInterface::State state = contact->state();
  contact->forget_steps();
  BOOST_TEST((flux_coupled == NodeFlags(4, false)));
  contact->restore(state);
  BOOST_TEST((flux_coupled == NodeFlags(4, true)));
}

/// The geometric part of the tangent is computed at the start of an iteration, from the points at which averages are
/// linearised; at other positions it is computed from the points there.
BOOST_AUTO_TEST_CASE(the_tangent_is_the_same_a_rounding_away_from_where_an_iteration_linearises) {
  std::mt19937 random(17);
  for (const bool two_pass : {false, true}) {
    Settings settings = explicit_settings(2.5, 1.5, 0.8);
    settings.two_pass = two_pass;
    Scene scene(facing_grids(FacetType::quad4, FacetType::tri3, 0.08, 2, 3), effects_of(true, 1), settings);
    scene.disturb(0.02, random);
    const auto contact = scene.contact();
    accept_any_load(*contact);
    contact->begin_iteration(scene.fields);
    const GlobalLayout layout(scene);
    const MatrixXd at_point = assembled_tangent(*contact, layout, scene.fields, 0.3);
    double& moved = scene.fields[Side::primary].position(0, 0);
    moved = std::nextafter(moved, moved + 1);
    contact->project(scene.position());
    BOOST_TEST(relative_error(assembled_tangent(*contact, layout, scene.fields, 0.3), at_point) <= rounding);
  }
}
