#include "contact/interface/load_rounding.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <limits>

using namespace test;

namespace {

/// The load rounding of a scene that is moved along x.
double rounding_at(double x, const Settings& settings) {
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.0625), effects_of(false, 0), settings);
  for (const Side side : both_sides) scene.fields[side].position.row(0).array() += x;
  const auto contact = scene.contact();
  contact->begin_iteration(scene.fields);
  return load_rounding_square(*contact, scene.fields);
}

}  // namespace

BOOST_AUTO_TEST_CASE(loads_round_as_positions_do_times_penalties_and_areas) {
  const Settings settings = explicit_settings(4, 2, 8);
  const Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.0625), effects_of(false, 0), settings);
  const auto contact = scene.contact();
  contact->begin_iteration(scene.fields);
  double largest = 0;
  for (const Side side : both_sides) largest = std::max(largest, scene.fields[side].position.cwiseAbs().maxCoeff());
  const VectorXd area = contact->pass(0).nodal_loads(seen_from(Side::primary, scene.fields)).area;
  const double of_positions = std::numeric_limits<double>::epsilon() * largest;
  const double expected = 2 * (4 * of_positions * area).squaredNorm();
  BOOST_TEST(expected > 0);
  BOOST_TEST(std::abs(load_rounding_square(*contact, scene.fields) - expected) <= 1e-9 * expected);
}

BOOST_AUTO_TEST_CASE(loads_far_from_the_origin_round_more) {
  const Settings settings = explicit_settings(4, 2, 8);
  const double ratio = rounding_at(4e3, settings) / rounding_at(1e3, settings);
  BOOST_TEST(std::abs(ratio - 16) < 0.1);
}

BOOST_AUTO_TEST_CASE(multipliers_that_are_unknowns_do_not_round_by_a_penalty) {
  Settings settings = explicit_settings(4, 2, 8);
  settings.enforcement = Enforcement::lagrange_multipliers;
  BOOST_TEST(rounding_at(1e3, settings) == 0);
}
