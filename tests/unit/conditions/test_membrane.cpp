#include "surfaces.h"

#include "contact/conditions/membrane.h"

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>

using namespace test;

namespace {

constexpr double conductance = 0.5;
constexpr double thermal_energy = 0.25;

/// Jumps and values of a solvent and two solutes at one node.
struct AtNode {
  NodalLoads loads;

  AtNode(const VectorXd& jump, const VectorXd& own) {
    loads.in_contact = loads.flux_coupled = NodeFlags(1, true);
    loads.flux_area = MatrixXd::Ones(jump.size(), 1);
    loads.jump = jump;
    loads.own = own;
  }
};

MembraneRule film(double permeance, double reflection) {
  MembraneRule rule;
  rule.conductance = conductance;
  rule.solutes[0] = {permeance, reflection};
  rule.thermal_energy = thermal_energy;
  return rule;
}

double flux(const MembraneRule& rule, Index field, const AtNode& at, double share = 1) {
  return scalar_conditions(effects_of(true, 2), rule, share)[field]->value(at.loads, 0, {});
}

VectorXd numbers(double pressure, double one, double two) {
  VectorXd all(3);
  all << pressure, one, two;
  return all;
}

/// Largest difference between a flux's derivatives and central differences.
double derivative_error(const ScalarCondition& condition, const AtNode& at) {
  constexpr double step = 1e-5;
  const FluxLaw law = condition.flux(at.loads, 0, {});
  double worst = 0;
  for (Index k = 0; k < at.loads.jump.rows(); ++k) {
    const auto difference = [&](MatrixXd NodalLoads::* values) {
      AtNode above = at;
      AtNode below = at;
      (above.loads.*values)(k, 0) += step;
      (below.loads.*values)(k, 0) -= step;
      return (condition.value(above.loads, 0, {}) - condition.value(below.loads, 0, {})) / (2 * step);
    };
    worst = std::max(worst, std::abs(law.d_jump[k] - difference(&NodalLoads::jump)));
    worst = std::max(worst, std::abs(law.d_own[k] - difference(&NodalLoads::own)));
  }
  return worst;
}

}  // namespace

BOOST_AUTO_TEST_CASE(an_ideal_semipermeable_film_passes_solvent_by_the_effective_pressure_alone) {
  const AtNode at(numbers(0.5, 2, 4), numbers(1, 3, 5));
  BOOST_TEST(flux(film(0, 1), 0, at) == conductance * 0.5);
  BOOST_TEST(flux(film(0, 1), 1, at) == 0.0);
}

BOOST_AUTO_TEST_CASE(solutes_that_a_film_lets_pass_drive_no_osmosis) {
  // For [p~] + R T [c~] = 0, the solutions in equilibrium with both sides have equal pressures.
  const AtNode at(numbers(-thermal_energy * 2, 2, 4), numbers(1, 3, 5));
  BOOST_TEST(flux(film(1, 0), 0, at) == 0.0);
}

BOOST_AUTO_TEST_CASE(a_solute_diffuses_through_a_film_without_flow) {
  const AtNode at(numbers(0, 2, 4), numbers(1, 3, 5));
  for (const double permeance : {0.0, 0.125, 4.0}) BOOST_TEST(flux(film(permeance, 1), 1, at) == permeance * 2);
}

BOOST_AUTO_TEST_CASE(a_field_without_a_film_is_continuous) {
  const AtNode at(numbers(0.5, 2, 4), numbers(1, 3, 5));
  const auto conditions = scalar_conditions(effects_of(true, 2), film(1, 0.5), 1);
  BOOST_TEST(!conditions[0]->is_enforced());
  BOOST_TEST(!conditions[1]->is_enforced());
  BOOST_TEST(conditions[2]->is_enforced());
  BOOST_TEST(conditions[2]->value(at.loads, 0, {0.25, 8}) == 0.25 + 8 * 4);
  BOOST_TEST(conditions[2]->drivers() == only(2));
}

BOOST_AUTO_TEST_CASE(fluxes_know_what_drives_them) {
  const auto carried = scalar_conditions(effects_of(true, 2), film(1, 0.5), 1);
  BOOST_TEST(carried[0]->drivers() == (only(0) | only(1)));
  BOOST_TEST(carried[1]->drivers() == (only(0) | only(1)));
  const auto reflected = scalar_conditions(effects_of(true, 2), film(1, 1), 1);
  BOOST_TEST(reflected[0]->drivers() == only(0));
  BOOST_TEST(reflected[1]->drivers() == only(1));
}

/// The profile within the membrane satisfies -P c' + s c = j over the unit thickness, with c(0) = c1 and c(1) = c2.
BOOST_AUTO_TEST_CASE(a_carried_solute_has_the_flux_of_the_film_s_own_profile) {
  constexpr double permeance = 0.75;
  constexpr double reflection = 0.25;
  constexpr double solvent_jump = 1.5;
  const double c1 = 3;
  const double c2 = 1;
  const AtNode at(numbers(solvent_jump, c1 - c2, 0), numbers(0, c1, 0));
  const double w = flux(film(permeance, reflection), 0, at);
  BOOST_TEST(w == conductance * (solvent_jump + thermal_energy * (1 - reflection) * (c1 - c2)));
  const double s = (1 - reflection) * w;
  const double growth = std::exp(s / permeance);
  const double exact = s * (c1 * growth - c2) / (growth - 1);
  BOOST_TEST(std::abs(flux(film(permeance, reflection), 1, at) - exact) <= 8 * std::abs(exact) * rounding_fraction);
}

BOOST_AUTO_TEST_CASE(a_fast_flow_carries_what_it_comes_from) {
  for (const double pressure : {-1e6, 1e6}) {
    const AtNode at(numbers(pressure, 2, 0), numbers(0, 3, 0));
    const double w = flux(film(1e-3, 0), 0, at);
    const double upstream = pressure > 0 ? 3 : 1;
    BOOST_TEST(std::abs(flux(film(1e-3, 0), 1, at) / (w * upstream) - 1) <= rounding_fraction);
    BOOST_TEST(flux(film(0, 0), 1, at) == w * upstream);
  }
}

BOOST_AUTO_TEST_CASE(a_slow_flow_carries_the_mean_of_both_sides) {
  const AtNode at(numbers(1e-6, 0, 0), numbers(0, 3, 0));
  const AtNode apart(numbers(1e-6, 2, 0), numbers(0, 3, 0));
  MembraneRule rule = film(1, 0);
  rule.thermal_energy = 0;
  const double w = flux(rule, 0, at);
  BOOST_TEST(std::abs(flux(rule, 1, at) - 3 * w) <= 1e-9 * w);
  BOOST_TEST(std::abs(flux(rule, 1, apart) - (2 + 2 * w)) <= w * w);  // P [c] + <c> w, up to [c] w^2/(12 P)
}

BOOST_AUTO_TEST_CASE(a_solute_is_not_carried_where_no_solvent_crosses) {
  AtNode at(numbers(0.5, 2, 4), numbers(1, 3, 5));
  at.loads.flux_area(0, 0) = 0;
  BOOST_TEST(flux(film(0.125, 0), 1, at) == 0.125 * 2);
}

BOOST_AUTO_TEST_CASE(two_passes_share_a_film) {
  const AtNode at(numbers(0.5, 2, 4), numbers(1, 3, 5));
  for (const Index field : {0, 1})
    BOOST_TEST(std::abs(2 * flux(film(0.5, 0.25), field, at, 0.5) - flux(film(0.5, 0.25), field, at)) <= 1e-15);
}

BOOST_AUTO_TEST_CASE(no_flux_produces_less_than_no_entropy) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    const VectorXd c = random_values(2, 0.01, 4, random);
    const double pressure = random_values(1, -2, 2, random)[0];
    const double reflection = random_values(1, 0, 1, random)[0];
    const AtNode at(numbers(pressure, c[0] - c[1], 0), numbers(0, c[0], 0));
    const double w = flux(film(0.5, reflection), 0, at);
    const double j = flux(film(0.5, reflection), 1, at);
    BOOST_TEST(w * pressure + j * thermal_energy * std::log(c[0] / c[1]) >= -1e-14);
  }
}

BOOST_AUTO_TEST_CASE(fluxes_of_films_have_their_derivatives) {
  // The ratio of flow to permeance goes from 1e-5, where B is evaluated as a series, to 500, where only one side
  // determines the flux.
  std::mt19937 random(11);
  for (const double pressure : {-500.0, -1.0, -1e-5, 0.0, 1e-5, 2e-3, 1.0, 500.0}) {
    const AtNode at(numbers(pressure, 1e-6, 0.5), numbers(0.5, 3, 5));
    MembraneRule rule = film(0.5, 0.25);
    rule.solutes[1] = {0.25, 0.5};
    const auto conditions = scalar_conditions(effects_of(true, 2), rule, 1);
    for (const auto& condition : conditions) BOOST_TEST(derivative_error(*condition, at) <= 1e-7);
  }
}
