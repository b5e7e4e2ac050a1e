#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>

using namespace test;

namespace {

/// Two facing unit squares whose distance a test changes between iterations.
struct Approach {
  Scene scene;
  std::unique_ptr<ContactInterface> contact;

  explicit Approach(double overlap)
      : scene(facing_grids(FacetType::quad4, FacetType::quad4, overlap), effects_of(true, 1),
              explicit_settings(4, 2, 8)),
        contact(scene.contact()) {
    contact->begin_iteration(scene.fields);
  }

  /// Ends the iteration at another distance and begins the next one there.
  void move_to(double overlap) {
    scene.fields[Side::secondary].position.row(2).setConstant(-overlap);
    contact->project(scene.position());
    contact->begin_iteration(scene.fields);
  }

  /// In contact, flux-coupled or not.
  std::ptrdiff_t closed() const {
    const std::vector<bool> nodes = contact->pass(0).nodal_loads(seen_from(Side::primary, scene.fields)).in_contact;
    return std::count(nodes.begin(), nodes.end(), true);
  }

  std::ptrdiff_t flux_coupled() const {
    const std::vector<bool> nodes = contact->nodes_in_contact()[Side::primary];
    return std::count(nodes.begin(), nodes.end(), true);
  }
};

constexpr std::ptrdiff_t all = 9;   // nodes of two by two facets
constexpr double touching = 1e-12;  // below what counts as touching at the start of a step

}  // namespace

BOOST_AUTO_TEST_CASE(nodes_that_touch_at_the_start_are_in_contact_and_rounding_does_not_open_them) {
  Approach approach(-touching);
  BOOST_TEST(approach.flux_coupled() == all);
  approach.move_to(-1e-16);
  BOOST_TEST(approach.flux_coupled() == all);
}

BOOST_AUTO_TEST_CASE(nodes_enter_within_a_step_only_where_they_overlap) {
  Approach approach(-0.125);
  BOOST_TEST(approach.flux_coupled() == 0);
  // Here neither status is wrong. To enter would change fluxes and pressure; the next step finds them touching.
  for (const double overlap : {-touching, 0.0, 1e-16}) {
    approach.move_to(overlap);
    BOOST_TEST(approach.flux_coupled() == 0);
  }
  approach.move_to(1e-6);
  BOOST_TEST(approach.flux_coupled() == all);
}

BOOST_AUTO_TEST_CASE(nodes_leave_where_they_are_pulled) {
  Approach approach(0.125);
  approach.move_to(-0.125);
  BOOST_TEST(approach.flux_coupled() == 0);
}

BOOST_AUTO_TEST_CASE(nodes_that_keep_changing_carry_load_but_are_not_flux_coupled) {
  Approach approach(0.125);
  for (int change = 1; change <= ActiveSetOptions().most_status_changes; ++change) {
    approach.move_to(change % 2 == 1 ? -0.125 : 0.125);
    BOOST_TEST(approach.flux_coupled() == (change % 2 == 1 ? 0 : all));
  }
  approach.move_to(0.125);
  BOOST_TEST(approach.flux_coupled() == 0);
  BOOST_TEST(balance(*approach.contact, approach.scene.fields).area > 0);
}

BOOST_AUTO_TEST_CASE(nodes_that_change_together_too_often_change_one_at_a_time) {
  Approach approach(0.125);
  for (int change = 1; change <= ActiveSetOptions().most_joint_changes + 1; ++change) {
    BOOST_TEST(approach.closed() == (change % 2 == 1 ? all : 0));
    approach.move_to(change % 2 == 1 ? -0.125 : 0.125);
  }
  BOOST_TEST(approach.closed() == 0);
  for (int change = 1; change <= all; ++change) {
    approach.move_to(0.125);
    BOOST_TEST(approach.closed() == change);
  }
}
