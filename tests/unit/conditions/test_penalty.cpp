#include "contact/conditions/penalty.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

using namespace test;

namespace {

const double infinity = std::numeric_limits<double>::infinity();
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Two surfaces of two facets each, with a solvent and one solute.
struct Sides {
  SurfaceMesh primary = grid_surface({FacetType::quad4, 2, 1}, 2).mesh;
  SurfaceMesh secondary = primary;
  Effects effects = effects_of(true, 1);
  Settings settings;

  Sides() {
    primary.stiffness << 1, 3;
    secondary.stiffness << 2, 6;  // harmonic mean 3
    primary.conductance << 4, 12, 5, 15;
    secondary.conductance << 8, 24, 10, 30;  // harmonic means 12 and 15
  }

  Penalties result() const { return penalties(primary, secondary, effects, settings); }
};

void check_close(double value, double expected) {
  BOOST_TEST(std::abs(value - expected) <= rounding * std::abs(expected));
}

}  // namespace

BOOST_AUTO_TEST_CASE(equal_sides_in_series_give_their_own_value) {
  BOOST_TEST(in_series(4, 4) == 4.0);
  check_close(in_series(1, 3), 1.5);
  check_close(in_series(3, 1), 1.5);
}

BOOST_AUTO_TEST_CASE(a_rigid_side_leaves_twice_the_other) {
  BOOST_TEST(in_series(infinity, 4) == 8.0);
  BOOST_TEST(in_series(4, infinity) == 8.0);
  BOOST_TEST(in_series(infinity, infinity) == infinity);
}

BOOST_AUTO_TEST_CASE(a_side_that_does_not_conduct_leaves_nothing) {
  for (const double other : {0.0, 4.0, infinity}) {
    for (const double closed : {0.0, -1.0, not_a_number}) {
      BOOST_TEST(in_series(closed, other) == 0.0);
      BOOST_TEST(in_series(other, closed) == 0.0);
    }
  }
}

BOOST_AUTO_TEST_CASE(automatic_penalties_multiply_the_stiffness_and_conductance_in_series) {
  Sides sides;
  sides.settings.traction = {true, 10};
  sides.settings.solvent = {true, 100};
  sides.settings.solute = {true, 1000};
  const Penalties result = sides.result();
  for (Index f = 0; f < 2; ++f) {
    check_close(result.stiffness[f], in_series(sides.primary.stiffness[f], 3));
    check_close(result.traction[f], 10 * in_series(sides.primary.stiffness[f], 3));
    check_close(result.conductance(0, f), in_series(sides.primary.conductance(0, f), 12));
    check_close(result.flux(0, f), 100 * in_series(sides.primary.conductance(0, f), 12));
    check_close(result.flux(1, f), 1000 * in_series(sides.primary.conductance(1, f), 15));
  }
}

BOOST_AUTO_TEST_CASE(explicit_penalties_are_taken_as_they_are) {
  Sides sides;
  sides.settings = explicit_settings(1400, 1e-3, 4e-4);
  const Penalties result = sides.result();
  BOOST_TEST((result.traction.array() == 1400).all());
  BOOST_TEST((result.flux.row(0).array() == 1e-3).all());
  BOOST_TEST((result.flux.row(1).array() == 4e-4).all());
  check_close(result.stiffness[0], in_series(1, 3));  // the scale of gaps remains the stiffness of the elements
}

BOOST_AUTO_TEST_CASE(the_solvent_conducts_at_least_a_part_of_what_elements_store_in_a_time_step) {
  Sides sides;
  sides.primary.stiffness.setConstant(2);
  sides.secondary.stiffness.setConstant(2);
  const Penalties steady = sides.result();
  sides.settings.solvent.time_step = 1e9;
  BOOST_TEST((sides.result().flux == steady.flux));
  sides.settings.solvent.time_step = 1e-9;
  const double stored = 0.5 / 1e-9;
  check_close(sides.result().conductance(0, 0), storage_part * stored);
  BOOST_TEST((sides.result().conductance.row(1) == steady.conductance.row(1)));
  // The default factor of fluxes times this part leaves the same fraction of the pressure as the default factor of the
  // traction leaves of the overlap.
  check_close(storage_part * default_flux_factor, default_traction_factor);
}

BOOST_AUTO_TEST_CASE(without_a_solvent_the_first_field_is_a_solute) {
  Sides sides;
  sides.effects = effects_of(false, 2);
  sides.settings = explicit_settings(1, 2, 3);
  BOOST_TEST((sides.result().flux.array() == 3).all());
}

BOOST_AUTO_TEST_CASE(impermeable_facets_of_the_other_side_do_not_lower_the_penalty) {
  Sides sides;
  sides.secondary.conductance.row(0) << 0, 24;
  check_close(sides.result().conductance(0, 0), in_series(4, 24));
  sides.secondary.conductance.row(0) << 0, 0;
  BOOST_TEST(sides.result().flux.row(0).norm() == 0.0);
  sides.primary.conductance(1, 0) = 0;
  BOOST_TEST(sides.result().flux(1, 0) == 0.0);
  BOOST_TEST(sides.result().flux(1, 1) > 0.0);
}

BOOST_AUTO_TEST_CASE(a_rigid_other_side_leaves_twice_the_stiffness) {
  Sides sides;
  sides.secondary.stiffness.setConstant(infinity);
  const Penalties result = sides.result();
  for (Index f = 0; f < 2; ++f) check_close(result.stiffness[f], 2 * sides.primary.stiffness[f]);
}

BOOST_AUTO_TEST_CASE(a_contact_of_solids_alone_has_no_flux_penalties) {
  Sides sides;
  sides.effects = effects_of(false, 0);
  const Penalties result = sides.result();
  BOOST_TEST(result.flux.rows() == 0);
  BOOST_TEST(result.traction.size() == 2);
}

BOOST_AUTO_TEST_CASE(a_gap_is_fixed_where_no_node_on_either_side_can_move) {
  Sides sides;
  BOOST_TEST(nodes_of_fixed_gap(sides.primary, sides.secondary).empty());
  sides.primary.immovable = NodeFlags(sides.primary.nodes, false);
  sides.primary.immovable[1] = true;
  BOOST_TEST(nodes_of_fixed_gap(sides.primary, sides.secondary).empty());
  sides.secondary.immovable = NodeFlags(sides.secondary.nodes, true);
  BOOST_TEST((nodes_of_fixed_gap(sides.primary, sides.secondary) == sides.primary.immovable));
  sides.secondary.immovable[0] = false;
  BOOST_TEST(nodes_of_fixed_gap(sides.primary, sides.secondary).empty());
  sides.secondary.immovable[0] = true;
  sides.primary.immovable = NodeFlags(sides.primary.nodes, true);
  BOOST_TEST(nodes_of_fixed_gap(sides.primary, sides.secondary).empty());
  sides.primary.immovable = NodeFlags(sides.primary.nodes, false);
  BOOST_TEST(nodes_of_fixed_gap(sides.primary, sides.secondary).empty());
}

BOOST_AUTO_TEST_CASE(a_softened_penalty_is_at_most_the_stiffness) {
  Sides sides;
  NodeFlags fixed(sides.primary.nodes, false);
  fixed[1] = true;
  for (const double factor : {0.5, 1e3}) {
    sides.settings.traction = {true, factor};
    const Penalties before = at_nodes(sides.result(), sides.primary);
    Penalties after = before;
    soften(after, fixed);
    for (Index node = 0; node < sides.primary.nodes; ++node)
      check_close(after.traction[node], (node == 1 ? std::min(factor, 1.0) : factor) * before.stiffness[node]);
    BOOST_TEST((after.flux.array() == before.flux.array()).all());
  }
}

BOOST_AUTO_TEST_CASE(a_reduction_divides_the_penalty_of_the_traction_alone) {
  Sides sides;
  const Penalties full = sides.result();
  sides.settings.reduced_traction.divisor = 100;
  const Penalties reduced = sides.result();
  for (Index f = 0; f < 2; ++f) check_close(reduced.traction[f], full.traction[f] / 100);
  BOOST_TEST((reduced.flux - full.flux).cwiseAbs().maxCoeff() == 0);
  BOOST_TEST((reduced.stiffness - full.stiffness).cwiseAbs().maxCoeff() == 0);
}
