#include "contact/interface/overlap.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

using namespace test;

namespace {

/// A surface of `cells` by `cells` facets opposite one of three by three, which overlap by `overlap`.
Scene overlapping(double overlap, int cells, bool two_pass = false) {
  Settings settings = explicit_settings(4, 2, 8);
  settings.two_pass = two_pass;
  return Scene(facing_grids(FacetType::quad4, FacetType::quad4, overlap, cells, 3), effects_of(false, 0), settings);
}

}  // namespace

BOOST_AUTO_TEST_CASE(overlap_is_measured_in_edges_of_the_facets) {
  const Scene scene = overlapping(0.0625, 2);
  const Overlap found = largest_overlap(*scene.contact(), scene.fields);
  BOOST_TEST(std::abs(found.depth - 0.0625) <= rounding);
  BOOST_TEST(std::abs(found.share - 0.125) <= rounding);
}

BOOST_AUTO_TEST_CASE(with_two_passes_the_smaller_facets_measure_it) {
  const Scene scene = overlapping(0.0625, 2, true);
  BOOST_TEST(std::abs(largest_overlap(*scene.contact(), scene.fields).share - 0.1875) <= rounding);
}

BOOST_AUTO_TEST_CASE(surfaces_that_are_apart_do_not_overlap) {
  const Scene scene = overlapping(-0.0625, 2);
  const Overlap found = largest_overlap(*scene.contact(), scene.fields);
  BOOST_TEST(found.depth == 0);
  BOOST_TEST(found.share == 0);
}

BOOST_AUTO_TEST_CASE(overlaps_may_exceed_the_search_radius_by_the_motion_of_a_step_and_by_accepted_ones) {
  for (const Integration integration : {Integration::gauss, Integration::segments}) {
    Settings settings = looking_as_far_as(0.125, explicit_settings(4, 2, 8));
    settings.integration = integration;
    Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.0625, 2, 3), effects_of(false, 0), settings);
    const auto contact = scene.contact();
    const auto overlap_after = [&](const Vector3d& both, double deeper) {
      for (const Side side : both_sides) scene.fields[side].position.colwise() += both;
      scene.fields[Side::secondary].position.row(2).array() -= deeper;
      contact->project(scene.position());
      return largest_overlap(*contact, scene.fields).depth;
    };
    BOOST_TEST(std::abs(overlap_after({0, 0, 0}, 0.1875) - 0.25) <= rounding);
    contact->accept_step(scene.fields);
    BOOST_TEST(std::abs(overlap_after({0.5, 0, 0}, 0.0) - 0.25) <= rounding);  // both bodies together
    BOOST_TEST(overlap_after({0, 0, 0}, -0.3125) == 0);
    contact->accept_step(scene.fields);
    BOOST_TEST(std::abs(overlap_after({0, 0, 0}, 0.3125) - 0.25) <= rounding);
    contact->forget_steps();
    BOOST_TEST(overlap_after({0.5, 0, 0}, 0.0) == 0);
  }
}
