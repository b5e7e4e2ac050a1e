#include "contact/tie/damage.h"
#include "contact/tie/joint_output.h"
#include "contact/tie/tie_output.h"

#include "tied_scene.h"

#include <boost/test/unit_test.hpp>

using namespace test;

namespace {

const Cohesive law{{{0.01, 0.02}, 2}, {0.002, 0.003}};
const Brittle brittle{{0.5, 0.5}};

/// A scene whose bodies have been moved apart such that bonds soften, or partly together.
TiedScene opened(FacetType one, FacetType two, double gap, double along, std::mt19937& random) {
  TiedScene tied(one, two, gap, Enforcement::penalty, {1, 1}, law);
  tied.scene.disturb(0.02, random);
  tied.scene.fields[Side::secondary].position.colwise() += Vector3d(0.04, 0.03, along);
  return tied;
}

void draw_apart(TiedScene& tied, double distance) {
  tied.scene.fields[Side::secondary].position.row(2).array() += distance;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_tangent_is_the_derivative_of_the_residual_as_damage_grows_and_stays) {
  for (const auto& [one, two] : facet_pairs()) {
    for (const double gap : {0.0, 0.1}) {
      for (const double along : {0.06, -0.06}) {
        std::mt19937 random(7);
        TiedScene tied = opened(one, two, gap, along, random);
        check_tangent(tied, random);
        DamageState damage = damage_after(*tied.tie, tied.scene.fields, 1);
        BOOST_TEST(damage.damage.minCoeff() > 0);
        BOOST_TEST(damage.damage.maxCoeff() < 1);
        damage.damage.array() = 0.5 + 0.5 * damage.damage.array();
        take_damage(*tied.tie, damage);
        check_tangent(tied, random);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(forces_and_moments_of_damaged_bonds_cancel) {
  for (const double along : {0.06, -0.06}) {
    std::mt19937 random(3);
    TiedScene tied = opened(FacetType::quad8, FacetType::tri3, 0.1, along, random);
    BOOST_TEST(damage_after(*tied.tie, tied.scene.fields, 1).damage.minCoeff() > 0);
    const VectorXd r = tied.residual(tied.pack());
    Vector3d force = Vector3d::Zero();
    for (Index n = 0; 5 * n < tied.nodal_size(); ++n) force += r.segment<3>(5 * n);
    BOOST_TEST(force.norm() < 1e-13);
    BOOST_TEST(moment_of(tied).norm() < 1e-13);
    BOOST_TEST(r.cwiseAbs().maxCoeff() > 1e-4);
  }
}

BOOST_AUTO_TEST_CASE(loads_of_damaged_bonds_turn_with_the_bodies) {
  std::mt19937 random(3);
  TiedScene tied = opened(FacetType::quad4, FacetType::tri6, 0.1, -0.06, random);
  const Matrix3Xd before = tied.tie->loads(tied.scene.fields).traction;
  for (SurfaceFields& fields : tied.scene.fields) turn_about(fields, quarter_turn);
  const Matrix3Xd turned = tied.tie->loads(tied.scene.fields).traction;
  BOOST_TEST((turned - quarter_turn * before).cwiseAbs().maxCoeff() < 1e-13);
}

BOOST_AUTO_TEST_CASE(brittle_nodes_break_where_the_mean_load_exceeds_the_strength_and_have_no_load_then) {
  for (const Enforcement enforcement :
       {Enforcement::penalty, Enforcement::augmented_lagrangian, Enforcement::lagrange_multipliers}) {
    TiedScene tied(FacetType::quad4, FacetType::quad4, 0, enforcement, {2, 2}, brittle);
    std::mt19937 random(1);
    tied.set_random_multipliers(random);
    draw_apart(tied, 0.1);
    const VectorXd forces = tied.residual(tied.pack());
    const DamageState after = damage_after(*tied.tie, tied.scene.fields, 3);
    take_damage(*tied.tie, after);
    const TieLoads left = tied.tie->loads(tied.scene.fields);
    BOOST_TEST(broken_nodes(*tied.tie) > 0);
    BOOST_TEST(broken_nodes(*tied.tie) < tied.tie->nodes().count());
    for (Index n = 0; n < tied.tie->nodes().count(); ++n) {
      const TiedNode& node = tied.tie->nodes()[n];
      const Vector3d traction = forces.segment<3>(5 * Index{node.node}) / node.traction.area;
      BOOST_TEST(tied.tie->state().damage.is_broken(n) == exceeds(brittle, traction, Vector3d(0, 0, 1)));
      BOOST_TEST(after.broken_at[n] == (tied.tie->state().damage.is_broken(n) ? 3.0 : -1.0));
      BOOST_TEST((left.traction.col(n).norm() == 0) == tied.tie->state().damage.is_broken(n));
      BOOST_TEST((left.flux.col(n).norm() == 0) == tied.tie->state().damage.is_broken(n));
    }
    check_tangent(tied, random);
  }
}

BOOST_AUTO_TEST_CASE(broken_nodes_couple_the_surfaces_only_by_equations_of_their_multipliers) {
  for (const Enforcement enforcement : {Enforcement::penalty, Enforcement::lagrange_multipliers}) {
    TiedScene tied(FacetType::quad4, FacetType::quad4, 0, enforcement, {2, 2}, brittle);
    const auto patches = [&] {
      int count = 0;
      tied.tie->for_each_patch([&](const Patch& /*patch*/) { ++count; });
      return count;
    };
    const int intact = patches();
    DamageState damage = tied.tie->state().damage;
    damage.damage[0] = 1;
    take_damage(*tied.tie, damage);
    BOOST_TEST(patches() == intact - (enforcement == Enforcement::penalty ? 3 : 0));  // a traction and two fluxes
  }
}

BOOST_AUTO_TEST_CASE(
    brittle_nodes_break_before_a_solution_only_if_their_load_exceeds_its_strength_by_more_than_its_error) {
  TiedScene tied(FacetType::quad4, FacetType::quad4, 0, Enforcement::penalty, {2, 2}, brittle);
  draw_apart(tied, 0.3);  // with the penalty 2, the load is 0.6 and the strength 0.5
  const auto broken = [&](double error) { return damage_after(*tied.tie, tied.scene.fields, 1, error).damage.sum(); };
  BOOST_TEST(broken(0.09) == static_cast<double>(tied.tie->nodes().count()));
  for (const double error : {0.11, 0.6, 3.0, std::numeric_limits<double>::infinity()}) BOOST_TEST(broken(error) == 0);
}

BOOST_AUTO_TEST_CASE(broken_nodes_and_those_tied_to_them_alone_are_free) {
  TiedScene tied(FacetType::quad4, FacetType::quad4, 0, Enforcement::penalty, {2, 2}, brittle);
  DamageState damage = tied.tie->state().damage;
  const PerSide<NodeFlags> whole = joined_nodes(*tied.tie);
  for (const NodeFlags& flags : whole) BOOST_TEST(std::count(flags.begin(), flags.end(), false) == 0);
  damage.damage.setOnes();
  damage.damage[0] = 0;
  take_damage(*tied.tie, damage);
  const PerSide<NodeFlags> joined = joined_nodes(*tied.tie);
  BOOST_TEST(std::count(joined[Side::primary].begin(), joined[Side::primary].end(), true) == 1);
  BOOST_TEST(std::count(joined[Side::secondary].begin(), joined[Side::secondary].end(), true) ==
             tied.tie->nodes()[0].secondary.count());
}

BOOST_AUTO_TEST_CASE(energies_of_the_output_are_those_of_the_law) {
  TiedScene tied(FacetType::quad4, FacetType::tri3, 0, Enforcement::penalty, {2, 3}, law);
  draw_apart(tied, 0.1);
  const DamageState half = damage_after(*tied.tie, tied.scene.fields, 1);
  const InterfaceOutput out = output(*tied.tie, tied.scene.fields, half);
  const double traction = 2 * (1 - half.damage[0]) * 0.1;  // with the penalty 2
  BOOST_TEST(std::abs(out.balance.bonds.stored - 0.5 * traction * 0.1) < 1e-15);
  BOOST_TEST(out.balance.bonds.broken_area == 0.0);
  for (const NodalOutput& nodes : out.nodes) {
    BOOST_TEST((nodes.breaking.damage.array() - half.damage[0]).abs().maxCoeff() < 1e-13);
    BOOST_TEST((nodes.breaking.opening.array() - 0.1).abs().maxCoeff() < 1e-13);
    BOOST_TEST((nodes.breaking.broken_at.array() == -1).all());
  }
  take_damage(*tied.tie, half);
  draw_apart(tied, 1);
  const DamageState end = damage_after(*tied.tie, tied.scene.fields, 2);
  const InterfaceOutput last = output(*tied.tie, tied.scene.fields, end);
  BOOST_TEST(std::abs(last.balance.bonds.dissipated - 0.002) < 1e-15);
  BOOST_TEST(std::abs(last.balance.bonds.broken_area - 1) < 1e-13);
  BOOST_TEST(last.balance.bonds.stored == 0.0);
  for (const NodalOutput& nodes : last.nodes) BOOST_TEST((nodes.breaking.broken_at.array() == 2).all());
}

BOOST_AUTO_TEST_CASE(outputs_of_tie_and_sliding_contact_are_means_over_their_areas) {
  InterfaceOutput tie;
  InterfaceOutput sliding;
  for (InterfaceOutput* const each : {&tie, &sliding}) {
    each->balance.flow.setConstant(1, 2);
    for (NodalOutput& nodes : each->nodes) {
      nodes.gap.setConstant(2, each == &tie ? 1 : 3);
      nodes.pressure.setConstant(2, each == &tie ? 2 : 6);
      nodes.flux.setConstant(1, 2, 1);
      nodes.jump.setConstant(1, 2, 1);
      nodes.tributary_area = each == &tie ? Vector2d(3, 0) : Vector2d(1, 0);
    }
  }
  tie.balance.area = 3;
  sliding.balance.area = 1;
  const InterfaceOutput both = together(tie, sliding);
  BOOST_TEST(both.balance.area == 4.0);
  BOOST_TEST(both.balance.flow[0] == 4.0);
  for (const NodalOutput& nodes : both.nodes) {
    BOOST_TEST(nodes.gap[0] == 1.5);
    BOOST_TEST(nodes.pressure[0] == 3.0);
    BOOST_TEST(nodes.gap[1] == 1.0);
    BOOST_TEST(nodes.tributary_area[0] == 4.0);
  }
}
