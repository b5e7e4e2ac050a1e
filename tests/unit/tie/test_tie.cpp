#include "contact/tie/tie_output.h"

#include "tied_scene.h"

#include <boost/test/unit_test.hpp>

#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <array>
#include <limits>
#include <variant>

using namespace test;

// Central differences have the error h^2/6 times the third derivative of the residual; the differences at 2h have four
// times this error. Their change is therefore three times the error at h. The rounding error of a sum divided by h is
// added.
BOOST_AUTO_TEST_CASE(the_tangent_is_the_derivative_of_the_residual) {
  for (const auto& [one, two] : facet_pairs()) {
    for (const Enforcement enforcement : {Enforcement::penalty, Enforcement::lagrange_multipliers}) {
      for (const double gap : {0.0, 0.1}) {
        std::mt19937 random(7);
        TiedScene tied(one, two, gap, enforcement, {1, 1});
        tied.scene.disturb(0.02, random);
        tied.set_random_multipliers(random);
        check_tangent(tied, random);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(kept_gaps_and_cohesive_bonds_alone_couple_directions) {
  const Cohesive cohesive{{{0.01, 0.02}, 2}, {0.002, 0.003}};
  for (const double gap : {0.0, 0.1}) {
    for (const BreakingLaw& law : {BreakingLaw(), BreakingLaw(Brittle{{0.5, 0.5}}), BreakingLaw(cohesive)}) {
      std::mt19937 random(7);
      TiedScene tied(FacetType::quad4, FacetType::tri3, gap, Enforcement::penalty, {1, 1}, law);
      tied.scene.disturb(0.02, random);
      const MatrixXd tangent = tied.tangent();
      double across = 0;
      for (Index i = 0; i < tied.nodal_size(); ++i) {
        for (Index j = 0; j < tied.nodal_size(); ++j) {
          if (i % 5 != j % 5) across = std::max(across, std::abs(tangent(i, j)));
        }
      }
      BOOST_TEST(couples_directions(*tied.tie) == (gap > 0 || std::holds_alternative<Cohesive>(law)));
      BOOST_TEST((across > 0) == couples_directions(*tied.tie));
    }
  }
}

BOOST_AUTO_TEST_CASE(the_tangent_is_symmetric) {
  std::mt19937 random(5);
  for (const Enforcement enforcement : {Enforcement::penalty, Enforcement::lagrange_multipliers}) {
    TiedScene tied(FacetType::quad4, FacetType::tri6, 0.1, enforcement);
    tied.scene.disturb(0.02, random);
    tied.set_random_multipliers(random);
    const MatrixXd tangent = tied.tangent();
    BOOST_TEST((tangent - tangent.transpose()).cwiseAbs().maxCoeff() <= 1e-14 * tangent.cwiseAbs().maxCoeff());
  }
}

BOOST_AUTO_TEST_CASE(a_rigid_turn_loads_nothing_with_a_gap_that_is_kept_and_without) {
  for (const auto& [one, two] : facet_pairs()) {
    for (const double gap : {0.0, 0.1, -0.05}) {
      TiedScene tied(one, two, gap);
      for (SurfaceFields& fields : tied.scene.fields) turn_about(fields, quarter_turn);
      BOOST_TEST(tied.tie->loads(tied.scene.fields).traction.cwiseAbs().maxCoeff() < 1e-13);
    }
  }
}

BOOST_AUTO_TEST_CASE(forces_and_moments_of_both_sides_cancel) {
  for (const double gap : {0.0, 0.1}) {
    std::mt19937 random(3);
    TiedScene tied(FacetType::quad8, FacetType::tri3, gap);
    tied.scene.disturb(0.05, random);
    const VectorXd r = tied.residual(tied.pack());
    Vector3d force = Vector3d::Zero();
    for (Index n = 0; 5 * n < tied.nodal_size(); ++n) force += r.segment<3>(5 * n);
    BOOST_TEST(force.norm() < 1e-13);
    BOOST_TEST(moment_of(tied).norm() < 1e-13);
    BOOST_TEST(r.cwiseAbs().maxCoeff() > 1e-4);
  }
}

BOOST_AUTO_TEST_CASE(linear_fields_have_no_jump_and_uniform_ones_no_weight) {
  for (const auto& [one, two] : facet_pairs()) {
    TiedScene tied(one, two, 0);
    for (SurfaceFields& fields : tied.scene.fields) {
      fields.scalar.col(0) = fields.position.transpose() * Vector3d(1, 2, 3);
      fields.scalar.col(1).setConstant(4);
    }
    const TieLoads loads = tied.tie->loads(tied.scene.fields);
    BOOST_TEST(loads.jump.cwiseAbs().maxCoeff() < 1e-13);
    BOOST_TEST(loads.gap.cwiseAbs().maxCoeff() < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(the_areas_of_tied_nodes_are_that_of_what_faces_the_other_surface) {
  TiedScene tied(FacetType::quad4, FacetType::tri3, 0.1);
  double area = 0;
  for (const TiedNode& node : tied.tie->nodes()) {
    area += node.traction.area;
    BOOST_TEST(std::abs(node.traction.weights.sum()) < 1e-14);
    BOOST_TEST(std::abs(node.secondary_shares.sum() - 1) < 1e-14);
  }
  BOOST_TEST(std::abs(area - 1) < 1e-13);
}

BOOST_AUTO_TEST_CASE(averages_over_covered_linear_facets_contain_a_single_primary_node) {
  for (const FacetType one : {FacetType::tri3, FacetType::quad4}) {
    for (const FacetType two : {FacetType::tri3, FacetType::quad4, FacetType::quad8}) {
      for (const BreakingLaw& law : {BreakingLaw(), BreakingLaw(Brittle{{0.5, 0.5}})}) {
        const TiedScene tied(one, two, 0, Enforcement::penalty, {2, 3}, law);
        for (const TiedNode& node : tied.tie->nodes()) {
          BOOST_TEST((node.primary == IndexedVector<int>{node.node}));
          BOOST_TEST(std::abs(node.traction.weights[0] + 1) < 1e-13);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(averages_of_cohesive_bonds_are_those_of_sliding_contact) {
  const TiedScene tied(FacetType::quad4, FacetType::quad4, 0, Enforcement::penalty, {2, 2},
                       Cohesive{{{0.01, 0.02}, 2}, {0.002, 0.003}});
  for (const TiedNode& node : tied.tie->nodes()) {
    BOOST_TEST(node.traction.weights.head(node.primary.count()).maxCoeff() < 0);
    BOOST_TEST(node.traction.weights.tail(node.secondary.count()).minCoeff() > 0);
  }
}

BOOST_AUTO_TEST_CASE(averages_over_matching_linear_facets_contain_a_single_node_of_each_surface) {
  const TiedScene tied(FacetType::quad4, FacetType::quad4, 0, Enforcement::penalty, {3, 3});
  for (const TiedNode& node : tied.tie->nodes()) {
    BOOST_TEST(node.count() == 2);
    const Vector3d apart = tied.scene.fields[Side::secondary].position.col(node.secondary[0]) -
                           tied.scene.fields[Side::primary].position.col(node.node);
    BOOST_TEST(apart.norm() < 1e-13);
  }
}

// A surface of one facet that the other one covers by a fifth, and one whose fields cross a part of the facet.
BOOST_AUTO_TEST_CASE(facets_without_dual_functions_have_those_of_sliding_contact) {
  for (const bool is_covered : {false, true}) {
    Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0, 1, 2), effects_of(true, 1));
    scene.settings.search.radius = 0.5;
    if (is_covered) {
      scene.mesh[Side::secondary].permeable[0] = 0;
    } else {
      scene.fields[Side::secondary].position.row(0).array() += 0.8;
    }
    const IndexedVector<TiedNode> nodes = find_tied_nodes(scene.mesh, scene.effects, scene.settings, scene.position());
    BOOST_TEST(!nodes.empty());
    for (const TiedNode& node : nodes) {
      BOOST_TEST((node.traction.weights.head(node.primary.count()).array() != 0).count() > 1);
      BOOST_TEST(node.traction.weights.tail(node.secondary.count()).minCoeff() >= 0);
      for (const TiedAverage& field : node.fields) BOOST_TEST(field.area > 0);
    }
  }
}

BOOST_AUTO_TEST_CASE(multipliers_that_are_unknowns_come_back_as_they_were_set) {
  std::mt19937 random(1);
  TiedScene tied(FacetType::quad4, FacetType::quad4, 0, Enforcement::lagrange_multipliers);
  tied.set_random_multipliers(random);
  const TieState before = tied.tie->state();
  tied.tie->set_unknowns(tied.tie->unknowns());
  BOOST_TEST((tied.tie->state().traction - before.traction).cwiseAbs().maxCoeff() < 1e-14);
  BOOST_TEST((tied.tie->state().flux - before.flux).cwiseAbs().maxCoeff() < 1e-14);
}

BOOST_AUTO_TEST_CASE(an_augmentation_takes_the_loads_up_and_has_slow_penalties_grow) {
  std::mt19937 random(2);
  TiedScene tied(FacetType::quad4, FacetType::quad4, 0, Enforcement::augmented_lagrangian);
  tied.scene.disturb(0.05, random);
  const TieLoads loads = tied.tie->loads(tied.scene.fields);
  BOOST_TEST(!tied.tie->augment(tied.scene.fields));
  BOOST_TEST((tied.tie->state().traction == loads.traction));
  BOOST_TEST((tied.tie->state().flux == loads.flux));
  BOOST_TEST(tied.tie->augment(tied.scene.fields));  // the gaps have not changed
  BOOST_TEST(tied.tie->state().traction_penalty_scale == 10.0);
}

BOOST_AUTO_TEST_CASE(nodes_beyond_the_search_radius_are_counted_with_their_distance) {
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, -0.3), effects_of(false, 0));
  scene.settings.search.radius = 0.2;
  const IndexedVector<TiedNode> none = find_tied_nodes(scene.mesh, scene.effects, scene.settings, scene.position());
  BOOST_TEST(none.empty());
  const UntiedNodes untied = untied_nodes(none, scene.mesh, scene.settings, scene.position());
  BOOST_TEST(untied.too_far == scene.mesh[Side::primary].nodes);
  BOOST_TEST(std::abs(untied.largest_distance - 0.3) < 1e-14);
}

BOOST_AUTO_TEST_CASE(relocated_nodes_touch_the_other_surface) {
  TiedScene tied(FacetType::quad4, FacetType::quad4, 0.1);
  const Matrix3Xd moved = without_gaps(tied.tie->nodes(), tied.scene.mesh, tied.scene.settings, tied.scene.position());
  BOOST_TEST((moved.row(2).array() - 0.1).abs().maxCoeff() < 1e-14);
}

BOOST_AUTO_TEST_CASE(the_output_balances_and_has_tension_as_a_negative_pressure) {
  TiedScene tied(FacetType::quad4, FacetType::quad4, 0);
  tied.scene.fields[Side::secondary].position.row(2).array() += 0.25;
  const InterfaceOutput out = output(*tied.tie, tied.scene.fields);
  BOOST_TEST((out.balance.force - Vector3d(0, 0, 0.5)).norm() < 1e-13);
  BOOST_TEST(std::abs(out.balance.area - 1) < 1e-13);
  for (const NodalOutput& nodes : out.nodes) {
    BOOST_TEST((nodes.pressure.array() + 0.5).abs().maxCoeff() < 1e-13);
    BOOST_TEST((nodes.gap.array() - 0.25).abs().maxCoeff() < 1e-13);
    BOOST_TEST(std::abs(nodes.tributary_area.sum() - 1) < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(any_number_of_threads_gives_the_same_bits_of_a_tie) {
  TiedScene tied(FacetType::quad4, FacetType::tri3, 0.1, Enforcement::penalty, {6, 5});
  std::mt19937 random(1);
  tied.scene.disturb(0.02, random);
  const auto answers = [&]([[maybe_unused]] int threads) {
#ifdef _OPENMP
    omp_set_num_threads(threads);
#endif
    return std::pair<VectorXd, MatrixXd>(tied.residual(tied.pack()), tied.tangent());
  };
  const auto [residual, tangent] = answers(1);
  BOOST_TEST(residual.norm() > 0);
  for (const int threads : {2, 3}) {
    const auto [other, its_tangent] = answers(threads);
    BOOST_TEST((other == residual));
    BOOST_TEST((its_tangent == tangent));
  }
}
