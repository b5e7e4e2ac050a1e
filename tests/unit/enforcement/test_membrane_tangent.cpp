#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>

using namespace test;

namespace {

Settings with_film(Settings settings) {
  settings.membrane.conductance = 0.75;
  settings.membrane.solutes[0] = {0.5, 0.25};
  settings.membrane.thermal_energy = 0.5;
  return settings;
}

/// A scene with positive concentrations and all nodes in contact.
Scene film_scene(FacetType one, FacetType two, const Settings& settings, std::mt19937& random) {
  Scene scene(facing_grids(one, two, 0.08, 1, 2), effects_of(true, 2), with_film(settings));
  scene.disturb(0.02, random);
  return scene;
}

/// Relative error of a contact's tangent, including multipliers, with constant contact status.
double film_tangent_error(const Scene& scene, std::mt19937& random) {
  const auto contact = scene.contact();
  accept_any_load(*contact);
  const GlobalLayout layout(scene);
  const bool has_unknowns = layout.multipliers.size() > 0;
  const auto set_unknowns = [&](const VectorXd& mu) {
    if (has_unknowns) set_unknown_multipliers(*contact, mu);
  };
  set_unknowns(random_values(layout.multipliers.size(), -0.5, 0, random));
  contact->begin_iteration(scene.fields);
  VectorXd q(layout.size());
  q << layout.pack(scene.fields), has_unknowns ? unknown_multipliers(*contact) : VectorXd();
  const auto project = [&](const VectorXd& at) {
    const PerSide<SurfaceFields> fields = layout.unpack(at);
    contact->project({{fields[Side::primary].position, fields[Side::secondary].position}});
    set_unknowns(at.tail(layout.multipliers.size()));
    return fields;
  };
  const MatrixXd approximate = differences(
      [&](const VectorXd& at) {
        const PerSide<SurfaceFields> fields = project(at);
        return assembled_residual(*contact, layout, fields, 0.3);
      },
      q);
  const PerSide<SurfaceFields> fields = project(q);
  const MatrixXd exact = assembled_tangent(*contact, layout, fields, 0.3);
  BOOST_TEST(exact.norm() > 0.1);
  return (exact - approximate).norm() / exact.norm();
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_tangent_of_a_film_matches_differences_by_every_enforcement) {
  std::mt19937 random(17);
  for (const auto& [one, two] :
       {std::pair(FacetType::quad4, FacetType::tri3), std::pair(FacetType::tri6, FacetType::quad8)}) {
    for (const bool two_pass : {false, true}) {
      Settings settings = explicit_settings(2.5, 1.5, 0.8);
      settings.two_pass = two_pass;
      BOOST_TEST(film_tangent_error(film_scene(one, two, settings, random), random) <= 1e-7);
    }
    Settings lagrange = explicit_settings(2.5, 1.5, 0.8);
    lagrange.enforcement = Enforcement::lagrange_multipliers;
    BOOST_TEST(film_tangent_error(film_scene(one, two, lagrange, random), random) <= 1e-7);
  }
}

BOOST_AUTO_TEST_CASE(the_tangent_of_a_film_between_fixed_surfaces_matches_differences) {
  std::mt19937 random(19);
  for (const Enforcement enforcement : {Enforcement::penalty, Enforcement::lagrange_multipliers}) {
    Settings settings = explicit_settings(2.5, 1.5, 0.8);
    settings.enforcement = enforcement;
    Scene scene = film_scene(FacetType::quad4, FacetType::tri3, settings, random);
    scene.effects.traction = false;
    const auto contact = scene.contact();
    const GlobalLayout layout(scene);
    const VectorXd q = layout.pack(scene.fields);
    const auto residual = [&](const VectorXd& fields) {
      VectorXd all(layout.size());
      all << fields, layout.multipliers.size() > 0 ? unknown_multipliers(*contact) : VectorXd();
      return assembled_residual(*contact, layout, layout.unpack(all), 0.3);
    };
    // Positions have no rows and columns in this tangent.
    const MatrixXd approximate = differences(residual, q);
    const MatrixXd exact = assembled_tangent(*contact, layout, scene.fields, 0.3).leftCols(q.size());
    BOOST_TEST((exact - approximate).norm() <= 1e-7 * exact.norm());
  }
}

BOOST_AUTO_TEST_CASE(augmentations_leave_the_law_of_a_film_as_it_is) {
  Settings settings = explicit_settings(2.5, 1.5, 0.8);
  settings.enforcement = Enforcement::augmented_lagrangian;
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.08), effects_of(true, 1), with_film(settings));
  scene.set_field(0, 1, 0.25);
  scene.set_field(1, 2, 0.5);
  const auto contact = scene.contact();
  const VectorXd before = output(*contact, scene.fields).balance.flow;
  for (int times = 0; times < 3; ++times) contact->augment(scene.fields);
  BOOST_TEST((output(*contact, scene.fields).balance.flow - before).norm() <= rounding * before.norm());
  BOOST_TEST(before[0] != 0.0);
  BOOST_TEST((contact->pass(0).laws().multipliers.flux_penalty_scale.array() == 1).all());
}

BOOST_AUTO_TEST_CASE(the_film_follows_the_settings) {
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.08), effects_of(true, 1),
              with_film(explicit_settings(2.5, 1.5, 0.8)));
  scene.set_field(0, 1, 0.25);
  const auto contact = scene.contact();
  const double before = output(*contact, scene.fields).balance.flow[0];
  Settings twice = scene.settings;
  twice.membrane.conductance = 2 * *scene.settings.membrane.conductance;
  contact->update_laws(twice);
  BOOST_TEST(std::abs(output(*contact, scene.fields).balance.flow[0] - 2 * before) <= rounding * std::abs(before));
}
