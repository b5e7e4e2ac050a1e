#include "contact/interface/interface.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>

using namespace test;

namespace {

constexpr double dt = 0.25;
constexpr double around = 0.04;                          // gap next to the spike
constexpr int cells = 8;                                 // of the secondary surface; its facets have edges of 1/8
constexpr double least = penetration_tolerance / cells;  // largest overlap that is not detected at a flat facet
constexpr double deep = 2 * penetration_tolerance;       // the edge of the primary facet is 1

/// A secondary surface of eight by eight facets with a spike in the middle, opposite a single primary facet.
struct Spike {
  Scene scene;
  Index tip = 0;
  std::unique_ptr<ContactInterface> contact;

  explicit Spike(double depth, double gap = around, Settings settings = explicit_settings(4, 2, 8),
                 FacetType primary = FacetType::quad4)
      : scene(facing_grids(primary, FacetType::quad4, -gap, 1, cells), effects_of(true, 1), settings) {
    tip = spike_at(0.5, depth);
    scene.set_field(0, 0.5, 0.25);
    scene.set_field(1, 1, 3);
    begin();
  }

  /// Replaces the primary facet by a row of facets, and makes the secondary surface flat.
  void over_row(int facets) {
    const GridSurface row = grid_surface({FacetType::quad4, facets, 1}, scene.effects.scalar_fields());
    scene.mesh[Side::primary] = row.mesh;
    scene.fields[Side::primary] = {row.position, MatrixXd::Zero(row.mesh.nodes, scene.effects.scalar_fields())};
    scene.fields[Side::secondary].position.row(2).setConstant(around);
  }

  /// Moves the secondary node nearest to x on the middle line to a depth. Returns the node.
  Index spike_at(double x, double depth) {
    Matrix3Xd& x2 = scene.fields[Side::secondary].position;
    Index node = 0;
    (x2.topRows<2>().colwise() - Vector2d(x, 0.5)).colwise().norm().minCoeff(&node);
    x2(2, node) = -depth;
    return node;
  }

  /// Begins with the present scene.
  void begin() {
    contact = scene.contact();
    go_on();
  }

  UndetectedPenetration check() { return contact->check_penetration(scene.fields); }

  /// Continues the iterations, as a host does after a rejected convergence.
  void go_on() { contact->begin_iteration(scene.fields); }
};

}  // namespace

BOOST_AUTO_TEST_CASE(an_overlap_that_primary_nodes_miss_is_detected_once) {
  Spike spike(deep);
  BOOST_TEST(spike.contact->is_solution(spike.scene.fields));
  BOOST_TEST(spike.contact->passes() == 1u);
  const UndetectedPenetration found = spike.check();
  BOOST_TEST(found.nodes == 1);
  BOOST_TEST(std::abs(found.depth - deep) <= rounding);
  BOOST_TEST(std::abs(found.share - deep / std::hypot(1.0 / cells, deep + around)) <= rounding);  // edges of the spike
  BOOST_TEST(spike.contact->passes() == 2u);
  BOOST_TEST(!spike.contact->is_solution(spike.scene.fields));
  spike.go_on();
  BOOST_TEST(spike.contact->is_solution(spike.scene.fields));
  BOOST_TEST(spike.check().nodes == 0);
  BOOST_TEST(spike.contact->undetected_penetration().nodes == 0);
}

BOOST_AUTO_TEST_CASE(nothing_is_detected_where_nothing_is_missed) {
  const auto detected = [](Spike spike) { return spike.check().nodes; };
  BOOST_TEST(detected(Spike(0.9 * least)) == 0);
  BOOST_TEST(detected(Spike(1.1 * least)) == 1);
  BOOST_TEST(detected(Spike(-deep, 2 * deep)) == 0);    // a gap
  BOOST_TEST(detected(Spike(deep, -0.5 * deep)) == 0);  // the primary facet is in contact
  Settings settings = explicit_settings(4, 2, 8);
  settings.two_pass = true;
  BOOST_TEST(detected(Spike(deep, around, settings)) == 0);
}

BOOST_AUTO_TEST_CASE(a_penetration_check_node_has_the_law_of_its_mean_gap) {
  Spike spike(deep);
  spike.check();
  spike.go_on();
  const NodalLoads loads = spike.contact->pass(1).nodal_loads(seen_from(Side::secondary, spike.scene.fields));
  for (Index node = 0; node < loads.traction.size(); ++node) {
    BOOST_TEST((loads.traction[node] < 0) == (node == spike.tip));
  }
  BOOST_TEST(std::abs(loads.traction[spike.tip] - 4 * loads.gap[spike.tip]) <= rounding);
  BOOST_TEST(spike.contact->nodes_in_contact()[Side::secondary][static_cast<std::size_t>(spike.tip)]);
}

BOOST_AUTO_TEST_CASE(a_mean_that_is_open_leaves_a_penetration_check_node_without_load) {
  Spike spike(deep, 2 * deep);
  BOOST_TEST(spike.check().nodes == 1);
  BOOST_TEST(spike.contact->is_solution(spike.scene.fields));
  BOOST_TEST(spike.contact->undetected_penetration().nodes == 1);
  BOOST_TEST(std::abs(spike.contact->undetected_penetration().depth - deep) <= rounding);
}

BOOST_AUTO_TEST_CASE(nodes_that_face_no_entered_facet_cannot_close) {
  // Two adjacent primary facets have a spike each: one at the tolerance of sound meshes, one deeper.
  Spike spike(deep);
  Scene& scene = spike.scene;
  spike.over_row(2);
  const std::array<Index, 2> tips{spike.spike_at(0.25, deep), spike.spike_at(0.75, 0.9 * least)};
  spike.begin();
  BOOST_TEST(spike.check().nodes == 1);
  spike.go_on();
  const std::vector<int> detected = spike.contact->state().check_nodes;
  BOOST_TEST(std::binary_search(detected.begin(), detected.end(), static_cast<int>(tips[0])));
  BOOST_TEST(!std::binary_search(detected.begin(), detected.end(), static_cast<int>(tips[1])));
  const NodalLoads loads = spike.contact->pass(1).nodal_loads(seen_from(Side::secondary, scene.fields));
  BOOST_TEST(loads.traction[tips[0]] < 0.0);
  BOOST_TEST(loads.traction[tips[1]] == 0.0);
}

BOOST_AUTO_TEST_CASE(nothing_is_detected_beside_facets_in_contact) {
  // The first of a row of primary facets is in contact. The spike is at the second or the third.
  const auto detected = [](double x) {
    Spike spike(deep);
    spike.over_row(3);
    Matrix3Xd& x1 = spike.scene.fields[Side::primary].position;
    for (Index node = 0; node < x1.cols(); ++node) x1(2, node) = x1(0, node) < 0.1 ? 2 * around : 0;
    spike.spike_at(x, deep);
    spike.begin();
    return spike.check().nodes;
  };
  BOOST_TEST(detected(0.5) == 0);
  BOOST_TEST(detected(0.875) == 1);
}

BOOST_AUTO_TEST_CASE(the_overlap_of_facets_with_an_arc_is_not_detected) {
  // Two primary facets with an angle between them, and a spike in the middle of the first one.
  const auto detected = [](double angle, double share) {
    Spike spike(deep);
    spike.over_row(2);
    Matrix3Xd& x1 = spike.scene.fields[Side::primary].position;
    for (Index node = 0; node < x1.cols(); ++node) {
      if (x1(0, node) > 0.75) x1.col(node) += 0.5 * Vector3d(std::cos(angle) - 1, 0, -std::sin(angle));
    }
    const double edge = 1;  // across the row
    spike.spike_at(0.25, share * penetration_tolerance * edge);
    spike.begin();
    return spike.check().nodes;
  };
  constexpr double half = 4 * penetration_tolerance;  // half of the angle of the tolerance
  BOOST_TEST(detected(half, 0.45) == 0);
  BOOST_TEST(detected(half, 0.55) == 1);
  BOOST_TEST(detected(2 * half, 0.95) == 0);
  BOOST_TEST(detected(2 * half, 1.05) == 1);
  BOOST_TEST(detected(1.5, 0.45) == 1);  // an edge of the body
}

BOOST_AUTO_TEST_CASE(residual_and_tangent_agree_with_penetration_check_nodes) {
  std::mt19937 random(3);
  double worst = 0;
  for (const FacetType primary : all_facets) {
    Spike spike(deep, around, explicit_settings(2.5, 1.5, 0.8), primary);
    spike.check();
    spike.scene.disturb(0.002, random);
    spike.contact->project(spike.scene.position());
    spike.contact->end_iterations();  // the next tangent has its geometric part at the loads of the state itself
    accept_any_load(*spike.contact);
    spike.go_on();
    const Scene& scene = spike.scene;
    const GlobalLayout layout(scene);
    const auto residual = [&](const VectorXd& at) {
      const PerSide<SurfaceFields> fields = layout.unpack(at);
      spike.contact->project({{fields[Side::primary].position, fields[Side::secondary].position}});
      return assembled_residual(*spike.contact, layout, fields, dt);
    };
    const MatrixXd approximate = differences(residual, layout.pack(scene.fields));
    spike.contact->project(scene.position());
    const MatrixXd exact = assembled_tangent(*spike.contact, layout, scene.fields, dt);
    BOOST_TEST(exact.norm() > 0.0);
    worst = std::max(worst, relative_error(approximate, exact));
  }
  BOOST_TEST_MESSAGE("largest relative difference " << worst);
  BOOST_TEST(worst <= difference_tolerance);
}

BOOST_AUTO_TEST_CASE(forces_flows_and_output_add_up_where_one_pass_alone_bears) {
  Spike spike(deep);
  spike.check();
  spike.go_on();
  const Balance total = output(*spike.contact, spike.scene.fields).balance;
  const GlobalLayout layout(spike.scene);
  const VectorXd residual = assembled_residual(*spike.contact, layout, spike.scene.fields, dt);
  PerSide<VectorXd> sum{{VectorXd::Zero(5), VectorXd::Zero(5)}};
  for (const Side side : both_sides) {
    for (Index node = 0; node < layout.nodes[side]; ++node)
      sum[side] += residual.segment(layout.entry(side, node, 0), 5);
  }
  BOOST_TEST((sum[Side::primary] + sum[Side::secondary]).norm() <= rounding);
  BOOST_TEST((sum[Side::primary].head<3>() - total.force).norm() <= rounding);
  BOOST_TEST(total.force[2] < 0.0);
  for (const Side side : both_sides) {
    const NodalOutput out = output(*spike.contact, spike.scene.fields).nodes[side];
    const double sign = side == Side::primary ? 1 : -1;
    BOOST_TEST(std::abs(out.tributary_area.sum() - total.area) <= rounding);
    for (Index k = 0; k < 2; ++k) {
      const double flow = sign * out.flux.row(k).dot(out.tributary_area);
      BOOST_TEST(std::abs(flow - total.flow[k]) <= rounding * std::abs(flow));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_state_holds_the_penetration_check_nodes_and_a_step_tried_again_forgets_it) {
  Spike spike(deep);
  const ContactInterface::State before = spike.contact->state();
  BOOST_TEST(before.check_nodes.empty());
  spike.check();
  spike.go_on();
  spike.contact->augment(spike.scene.fields);
  const ContactInterface::State after = spike.contact->state();
  const GlobalLayout layout(spike.scene);
  const auto residual_of = [&](ContactInterface& contact) {
    contact.project(spike.scene.position());
    return assembled_residual(contact, layout, spike.scene.fields, dt);
  };
  spike.contact->end_iterations();
  const VectorXd expected = residual_of(*spike.contact);
  BOOST_TEST(expected.norm() > 0.0);
  const auto fresh = spike.scene.contact();
  fresh->restore(after);
  BOOST_TEST((residual_of(*fresh) == expected));
  fresh->restore(before);
  BOOST_TEST(fresh->passes() == 1u);
  BOOST_TEST(residual_of(*fresh).norm() == 0.0);
}

BOOST_AUTO_TEST_CASE(beside_unknown_multipliers_penetration_check_nodes_have_penalties) {
  Settings settings;
  settings.enforcement = Enforcement::lagrange_multipliers;
  Spike spike(deep, around, settings);
  spike.check();
  spike.go_on();
  BOOST_TEST(spike.contact->pass(0).space().has_unknown_multipliers());
  BOOST_TEST(!spike.contact->pass(1).space().has_unknown_multipliers());
  BOOST_TEST(output(*spike.contact, spike.scene.fields).balance.force[2] < 0.0);
  BOOST_TEST(spike.contact->is_solution(spike.scene.fields));
}
