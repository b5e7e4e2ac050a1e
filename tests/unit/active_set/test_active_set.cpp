
#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <vector>

using namespace test;

namespace {

/// Two facing unit squares whose distance changes between iterations.
struct Approach {
  Scene scene;
  std::unique_ptr<ContactInterface> contact;

  /// `radius`: search radius; 0: default search distance. `cells`: per side of the secondary square.
  explicit Approach(double overlap, const Effects& effects = effects_of(true, 1), double radius = 0, int cells = 2)
      : scene(facing_grids(FacetType::quad4, FacetType::quad4, overlap, 2, cells), effects,
              looking_as_far_as(radius, explicit_settings(4, 2, 8))),
        contact(scene.contact()) {
    contact->begin_iteration(scene.fields);
  }

  /// Ends the iteration at another distance and begins the next one. `slope`: increase of the overlap with x.
  void move_to(double overlap, double slope = 0) {
    SurfaceFields& secondary = scene.fields[Side::secondary];
    secondary.position.row(2) = -(overlap + slope * secondary.position.row(0).array());
    contact->project(scene.position());
    contact->begin_iteration(scene.fields);
  }

  /// The number of nodes in contact at the start of a step.
  std::ptrdiff_t closed_where_a_step_begins() {
    contact->end_iterations();
    contact->begin_iteration(scene.fields);
    return closed();
  }

  /// The number of nodes in contact, flux-coupled or not.
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
constexpr double touching = 1e-12;  // gap below the limit of touching at the start of a step

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
  // Neither status is wrong at these gaps. A change to contact would change fluxes and pressure; the next step begins
  // with touching surfaces.
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

BOOST_AUTO_TEST_CASE(rigid_bodies_part_an_iteration_later_once_in_a_step) {
  Approach approach(0.125, effects_of(false, 0));
  approach.contact->pass(0).laws().between_rigid_bodies = true;
  approach.move_to(-0.125);
  BOOST_TEST(approach.closed() == all);
  BOOST_TEST(!approach.contact->is_solution(approach.scene.fields));
  approach.move_to(-0.125);
  BOOST_TEST(approach.closed() == 0);
  approach.move_to(0.125);
  approach.move_to(-0.125);
  BOOST_TEST(approach.closed() == 0);
  BOOST_TEST(approach.closed_where_a_step_begins() == 0);
}

BOOST_AUTO_TEST_CASE(nodes_that_keep_changing_carry_load_but_are_not_flux_coupled) {
  Approach approach(0.125);
  for (int change = 1; change <= ActiveSetOptions().most_status_changes; ++change) {
    approach.move_to(change % 2 == 1 ? -0.125 : 0.125);
    BOOST_TEST(approach.flux_coupled() == (change % 2 == 1 ? 0 : all));
  }
  approach.move_to(0.125);
  BOOST_TEST(approach.flux_coupled() == 0);
  BOOST_TEST(output(*approach.contact, approach.scene.fields).balance.area > 0);
}

BOOST_AUTO_TEST_CASE(nodes_that_close_a_second_time_by_themselves_are_not_flux_coupled) {
  Approach approach(-0.125);
  approach.move_to(0.125);
  BOOST_TEST(approach.flux_coupled() == all);
  approach.move_to(-0.125);
  approach.move_to(0.125);
  BOOST_TEST(approach.closed() == all);
  BOOST_TEST(approach.flux_coupled() == 0);
}

namespace {

/// An active set in which node 0 opens and closes until it is at the edge, and node 1 closes in the last of these
/// changes.
struct Edge {
  Approach approach{0.125};
  ActiveSet active_set{approach.contact->pass(0).laws()};
  NodalLoads solution;

  const NodalLaws& laws() const { return approach.contact->pass(0).laws(); }

  /// Returns true if node 0 is flux-coupled at the end.
  bool come_and_go(bool with_another) {
    NodeFlags before(all, true);
    ContactStatus status;
    for (int change = 0; change <= ActiveSetOptions().most_status_changes; ++change) {
      NodeFlags updated = before;
      updated[0] = change % 2 == 1;
      if (with_another && change == ActiveSetOptions().most_status_changes) updated[1] = false;
      status = active_set.next(laws(), before, updated, true);
      before = updated;
    }
    solution.in_contact = status.in_contact;
    solution.flux_coupled = status.flux_coupled;
    return status.flux_coupled[0];
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_solution_has_nodes_tried_once_more_that_came_to_the_edge_while_others_changed) {
  Edge edge;
  BOOST_TEST(!edge.come_and_go(true));
  BOOST_TEST(edge.active_set.reconsiders_edge(edge.laws(), edge.solution));
  BOOST_TEST(!edge.come_and_go(true));
  BOOST_TEST(!edge.active_set.reconsiders_edge(edge.laws(), edge.solution));
}

BOOST_AUTO_TEST_CASE(nodes_that_have_cycled_alone_stay_at_the_edge) {
  Edge edge;
  BOOST_TEST(!edge.come_and_go(false));
  BOOST_TEST(!edge.active_set.reconsiders_edge(edge.laws(), edge.solution));
}

BOOST_AUTO_TEST_CASE(nodes_that_were_at_the_edge_in_the_last_accepted_step_stay_there) {
  Edge edge;
  Multipliers& last = edge.approach.contact->pass(0).laws().multipliers;
  last.accepted_traction.setConstant(-1);
  last.flux_coupled = NodeFlags(all, false);
  BOOST_TEST(!edge.come_and_go(true));
  BOOST_TEST(!edge.active_set.reconsiders_edge(edge.laws(), edge.solution));
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

BOOST_AUTO_TEST_CASE(nodes_that_have_not_cycled_change_together_with_the_first_that_has) {
  Approach approach(0.125);
  const NodalLaws& laws = approach.contact->pass(0).laws();
  ActiveSet active_set(laws);
  const NodeFlags open(all, false);
  NodeFlags two = open;
  two[0] = two[1] = true;
  NodeFlags status = open;
  for (int change = 1; change <= ActiveSetOptions().most_joint_changes + 1; ++change) {
    const NodeFlags asked = change % 2 == 1 ? two : open;
    status = active_set.next(laws, status, asked, true).in_contact;
    BOOST_TEST((status == asked));
  }
  NodeFlags expected(all, true);
  expected[0] = false;
  NodeFlags asked = expected;
  asked[1] = false;
  BOOST_TEST((active_set.next(laws, status, asked, true).in_contact == expected));
}

// ------------------------------------------------------------ where a step begins

const Effects elastic = effects_of(false, 0);

BOOST_AUTO_TEST_CASE(a_node_that_slid_without_friction_begins_a_step_sliding) {
  Effects effects = effects_of(false, 0);
  effects.friction_kind = FrictionKind::on_traction;
  Settings settings = explicit_settings(4, 2, 8);
  settings.friction.coefficient = 0.1;
  const Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.0625), effects, settings);
  const auto contact = scene.contact();
  ContactPass& pass = contact->pass(0);
  for (const bool slid : {true, false}) {
    pass.laws().multipliers.slips = NodeFlags(pass.laws().nodes(), slid);
    const NodalLoads loads = pass.nodal_loads({scene.fields[Side::primary], scene.fields[Side::secondary]});
    const NodeFlags slips = initial_friction(pass.laws(), loads).slips;
    for (Index node = 0; node < slips.count(); ++node) BOOST_TEST(slips[node] == slid);
  }
}

BOOST_AUTO_TEST_CASE(an_attempt_after_a_failed_one_begins_with_all_overlapping_points_until_a_step_is_accepted) {
  Approach approach(-0.1, elastic);
  NodalLaws& laws = approach.contact->pass(0).laws();
  std::ptrdiff_t overlapped = 0;
  std::ptrdiff_t closed = 0;
  // The middle node is raised until its own average overlaps, but not the averages of the nodes around it.
  for (int n = 0; n < 20 && closed == overlapped; ++n) {
    approach.scene.fields[Side::primary].position(2, 4) += 0.1;
    approach.contact->project(approach.scene.position());
    const NodeFlags around = overlapped_nodes(approach.contact->pass(0).space());
    overlapped = std::count(around.begin(), around.end(), true);
    closed = approach.closed_where_a_step_begins();
  }
  BOOST_TEST(closed > 0);
  BOOST_TEST_REQUIRE(closed < overlapped);
  laws.close_overlapped = true;
  BOOST_TEST(approach.closed_where_a_step_begins() == overlapped);
  approach.contact->accept_step(approach.scene.fields);
  BOOST_TEST(!laws.close_overlapped);
}

BOOST_AUTO_TEST_CASE(an_attempt_after_a_failed_one_begins_with_the_nearest_nodes_of_surfaces_that_nearly_touch) {
  Approach approach(-0.02, elastic);
  NodalLaws& laws = approach.contact->pass(0).laws();
  BOOST_TEST(approach.closed_where_a_step_begins() == 0);
  laws.close_overlapped = true;
  BOOST_TEST(approach.closed_where_a_step_begins() == all);
  approach.move_to(-0.01, -0.04);
  BOOST_TEST(approach.closed_where_a_step_begins() == 6);  // the gap around the others is more than twice the smallest
  approach.move_to(-0.1);
  BOOST_TEST(approach.closed_where_a_step_begins() == 0);
}

BOOST_AUTO_TEST_CASE(a_step_begins_with_all_overlapping_points_where_a_free_rigid_body_has_no_node_in_contact) {
  Approach approach(-0.1, elastic, 0, 3);
  NodalLaws& laws = approach.contact->pass(0).laws();
  std::ptrdiff_t overlapped = 0;
  const auto lower_one_node = [&](double by) {
    approach.scene.fields[Side::secondary].position(2, 5) -= by;
    approach.contact->project(approach.scene.position());
    const NodeFlags around = overlapped_nodes(approach.contact->pass(0).space());
    overlapped = std::count(around.begin(), around.end(), true);
  };
  while (overlapped == 0) lower_one_node(0.01);
  BOOST_TEST(approach.closed_where_a_step_begins() == 0);
  laws.holds_rigid_body = true;
  BOOST_TEST(approach.closed_where_a_step_begins() == overlapped);
  laws.holds_rigid_body = false;
  std::ptrdiff_t closed = 0;
  for (; closed == 0; closed = approach.closed_where_a_step_begins()) lower_one_node(0.01);
  BOOST_TEST_REQUIRE(closed < overlapped);
  laws.holds_rigid_body = true;
  BOOST_TEST(approach.closed_where_a_step_begins() == closed);
}
