#include "contact/pass.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <bitset>
#include <set>

using namespace test;

namespace {

constexpr double dt = 0.25;

/// A pass over the primary surface of a scene.
ContactPass pass_of(const Scene& scene, double radius = 1) {
  ContactPass pass(scene.mesh[Side::primary], scene.mesh[Side::secondary], scene.effects, scene.settings);
  pass.project(scene.fields[Side::primary].position, scene.fields[Side::secondary].position, radius);
  return pass;
}

void residual_of(const ContactPass& pass, const Scene& scene,
                 const std::function<void(const FacetPair&, const VectorXd&)>& use) {
  pass.residual(scene.fields[Side::primary], scene.fields[Side::secondary], dt, use);
}

void tangent_of(const ContactPass& pass, const Scene& scene,
                const std::function<void(const FacetPair&, const MatrixXd&)>& use) {
  pass.tangent(scene.fields[Side::primary], scene.fields[Side::secondary], dt, use);
}

/// Number of integration points in contact.
int contacts(const ContactPass& pass, const Scene& scene) {
  int count = 0;
  pass.for_each_contact(scene.fields[Side::primary], scene.fields[Side::secondary], dt,
                        [&](const PointContact&) { ++count; });
  return count;
}

/// Unit squares with an overlap of 1/16 and known penalties; three fields.
Scene overlapping_squares(FacetType one = FacetType::quad4, FacetType two = FacetType::quad4) {
  Scene scene(facing_grids(one, two, 0.0625), effects_of(true, 2), explicit_settings(4, 2, 8));
  scene.set_field(0, 0.5, 0.25);
  scene.set_field(1, 1, 0.5);
  scene.set_field(2, 0, 2);
  return scene;
}

std::vector<int> fields_in(FieldMask mask, int fields) {
  std::vector<int> result;
  for (int k = 0; k < fields; ++k) {
    if (std::bitset<64>(mask)[static_cast<std::size_t>(k)]) result.push_back(k);
  }
  return result;
}

/// Sum of a facet pair's residual over the primary nodes: force, then the flow of each local field times dt.
VectorXd primary_sum(const FacetPair& pair, const VectorXd& residual) {
  VectorXd sum = VectorXd::Zero(pair.layout.per_node());
  for (Index a = 0; a < pair.layout.primary_nodes(); ++a) {
    for (Index i = 0; i < 3; ++i) sum[i] += residual[pair.layout.displacement(a, i)];
    for (Index k = 0; k < pair.layout.scalar_fields(); ++k) sum[3 + k] += residual[pair.layout.scalar(a, k)];
  }
  return sum;
}

}  // namespace

BOOST_AUTO_TEST_CASE(points_follow_the_integration_order) {
  Scene scene = overlapping_squares(FacetType::quad4, FacetType::tri6);
  BOOST_TEST(pass_of(scene).points() == 4 * 4);
  scene.settings.integration_order = 3;
  BOOST_TEST(pass_of(scene).points() == 4 * 9);
  scene = overlapping_squares(FacetType::tri6);
  BOOST_TEST(pass_of(scene).points() == 8 * 7);
}

BOOST_AUTO_TEST_CASE(every_point_of_facing_surfaces_finds_the_point_opposite) {
  for (const FacetType one : all_facets) {
    for (const FacetType two : all_facets) {
      const Scene scene = overlapping_squares(one, two);
      const ContactPass pass = pass_of(scene);
      BOOST_TEST(static_cast<Index>(pass.pairs().size()) == pass.points());
      int found = 0;
      pass.for_each_contact(scene.fields[Side::primary], scene.fields[Side::secondary], dt,
                            [&](const PointContact& contact) {
                              ++found;
                              BOOST_TEST(std::abs(contact.kinematics.gap + 0.0625) <= rounding);
                              BOOST_TEST((contact.kinematics.normal - Vector3d(0, 0, 1)).norm() <= rounding);
                            });
      BOOST_TEST(found == pass.points());
    }
  }
}

BOOST_AUTO_TEST_CASE(a_uniform_overlap_and_jump_give_their_exact_force_and_flows) {
  for (const FacetType one : all_facets) {
    for (const FacetType two : all_facets) {
      const Scene scene = overlapping_squares(one, two);
      VectorXd sum = VectorXd::Zero(6);
      residual_of(pass_of(scene), scene,
                  [&](const FacetPair& pair, const VectorXd& r) { sum += primary_sum(pair, r); });
      // Area 1; t_n = -4/16 along +z; w = 2 (1/2 - 1/4); j = 8 (1 - 1/2) and 8 (0 - 2).
      VectorXd expected(6);
      expected << 0, 0, -0.25, dt * 0.5, dt * 4, dt * -16;
      BOOST_TEST((sum - expected).norm() <= rounding * expected.norm());
    }
  }
}

BOOST_AUTO_TEST_CASE(each_pair_of_facets_is_handed_out_once_and_is_in_the_profile) {
  std::mt19937 random(1);
  Scene scene(facing_grids(FacetType::quad4, FacetType::tri3, 0.05, 3, 4), effects_of(true, 1));
  scene.disturb(0.03, random);
  const ContactPass pass = pass_of(scene);
  using Key = std::pair<const Facet*, const Facet*>;
  std::set<Key> profile;
  pass.for_each_facet_pair(
      [&](const FacetPair& pair) { BOOST_TEST(profile.insert({&pair.primary, &pair.secondary}).second); });
  std::set<Key> loaded;
  residual_of(pass, scene, [&](const FacetPair& pair, const VectorXd& residual) {
    BOOST_TEST(loaded.insert({&pair.primary, &pair.secondary}).second);
    BOOST_TEST(residual.size() == pair.layout.size());
  });
  std::set<Key> stiff;
  tangent_of(pass, scene,
             [&](const FacetPair& pair, const MatrixXd&) { stiff.insert({&pair.primary, &pair.secondary}); });
  BOOST_TEST((loaded == stiff));
  BOOST_TEST(loaded.size() > 9U);
  BOOST_TEST(std::includes(profile.begin(), profile.end(), loaded.begin(), loaded.end()));
}

BOOST_AUTO_TEST_CASE(fields_that_one_side_does_not_know_are_not_there) {
  constexpr int fields = 5;
  std::mt19937 random(2);
  for (int sample = 0; sample < 20; ++sample) {
    Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.05, 2, 3),
                effects_of(sample % 2 == 0, fields - sample % 2));
    const int count = scene.effects.scalar_fields();
    scene.disturb(0.01, random);
    for (const Side side : both_sides) {
      for (FieldMask& mask : scene.mesh[side].permeable) mask = random() % (FieldMask{1} << unsigned{fields});
    }
    const ContactPass pass = pass_of(scene);
    const auto mask_of = [&](const FacetPair& pair) {
      const auto one = static_cast<std::size_t>(&pair.primary - scene.mesh[Side::primary].facets.data());
      const auto two = static_cast<std::size_t>(&pair.secondary - scene.mesh[Side::secondary].facets.data());
      return scene.mesh[Side::primary].permeable[one] & scene.mesh[Side::secondary].permeable[two];
    };
    int handed_out = 0;
    residual_of(pass, scene, [&](const FacetPair& pair, const VectorXd& residual) {
      ++handed_out;
      BOOST_TEST((pair.fields == fields_in(mask_of(pair), count)));
      BOOST_TEST(residual.size() == pair.layout.nodes() * (3 + static_cast<Index>(pair.fields.size())));
    });
    tangent_of(pass, scene, [&](const FacetPair& pair, const MatrixXd& tangent) {
      BOOST_TEST(tangent.rows() == pair.layout.nodes() * (3 + static_cast<Index>(pair.fields.size())));
    });
    pass.for_each_facet_pair(
        [&](const FacetPair& pair) { BOOST_TEST((pair.fields == fields_in(mask_of(pair), count))); });
    BOOST_TEST(handed_out > 0);
  }
}

BOOST_AUTO_TEST_CASE(the_flow_of_a_field_does_not_depend_on_its_place_or_on_the_other_fields) {
  std::mt19937 random(3);
  constexpr int fields = 4;
  Scene scene(facing_grids(FacetType::quad8, FacetType::tri3, 0.05), effects_of(false, fields));
  scene.disturb(0.01, random);
  const std::array<int, 3> chosen{2, 0, 3};  // the place of field k of the other scene in the first one
  Scene part(facing_grids(FacetType::quad8, FacetType::tri3, 0.05), effects_of(false, 3));
  for (const Side side : both_sides) {
    part.fields[side].position = scene.fields[side].position;
    for (Index k = 0; k < 3; ++k) {
      part.fields[side].scalar.col(k) = scene.fields[side].scalar.col(chosen[static_cast<std::size_t>(k)]);
    }
  }
  std::vector<VectorXd> whole;
  residual_of(pass_of(scene), scene, [&](const FacetPair&, const VectorXd& residual) { whole.push_back(residual); });
  std::size_t next = 0;
  residual_of(pass_of(part), part, [&](const FacetPair& pair, const VectorXd& residual) {
    BOOST_REQUIRE(next < whole.size());
    const LocalLayout layout(pair.layout.primary_nodes(), pair.layout.nodes() - pair.layout.primary_nodes(), fields);
    for (Index node = 0; node < layout.nodes(); ++node) {
      for (Index k = 0; k < 3; ++k) {
        const Index same = layout.scalar(node, chosen[static_cast<std::size_t>(k)]);
        BOOST_TEST(residual[pair.layout.scalar(node, k)] == whole[next][same]);
      }
    }
    ++next;
  });
  BOOST_TEST(next == whole.size());
}

BOOST_AUTO_TEST_CASE(as_many_fields_as_a_mask_holds_are_exchanged) {
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.05, 1, 1), effects_of(true, max_scalar_fields - 1),
              explicit_settings(1, 2, 3));
  for (Index k = 0; k < max_scalar_fields; ++k) scene.set_field(k, static_cast<double>(k), 0);
  residual_of(pass_of(scene), scene, [](const FacetPair& pair, const VectorXd& residual) {
    const VectorXd sum = primary_sum(pair, residual);
    for (Index k = 0; k < max_scalar_fields; ++k) {
      const double flow = dt * (k == 0 ? 2.0 : 3.0) * static_cast<double>(k);
      BOOST_TEST(std::abs(sum[3 + k] - flow) <= rounding * (1 + flow));
    }
  });
}

BOOST_AUTO_TEST_CASE(surfaces_that_touch_are_in_contact_and_those_apart_are_not) {
  for (const double gap : {0.0, 1e-14, 1e-3, 0.5}) {
    const Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, -gap), effects_of(true, 1));
    const ContactPass pass = pass_of(scene);
    BOOST_TEST(static_cast<Index>(pass.pairs().size()) == pass.points());
    BOOST_TEST(contacts(pass, scene) == (gap < 1e-10 ? pass.points() : 0));
    residual_of(pass, scene, [](const FacetPair&, const VectorXd& residual) { BOOST_TEST(residual.norm() == 0.0); });
  }
}

BOOST_AUTO_TEST_CASE(facets_farther_than_the_radius_are_not_seen) {
  const Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, -0.5), effects_of(false, 0));
  BOOST_TEST(pass_of(scene, 0.6).pairs().size() == 16U);
  BOOST_TEST(pass_of(scene, 0.4).pairs().empty());
}

BOOST_AUTO_TEST_CASE(points_beside_the_other_surface_are_not_in_contact) {
  PerSide<Grid> grids = facing_grids(FacetType::quad4, FacetType::quad4, 0.05);
  grids[Side::secondary].high[0] = 0.5;
  const Scene scene(grids, effects_of(false, 0));
  BOOST_TEST(pass_of(scene).pairs().size() == 8U);
}

BOOST_AUTO_TEST_CASE(coverage_is_the_share_of_the_area_around_a_node_in_contact) {
  for (const FacetType type : all_facets) {
    PerSide<Grid> grids = facing_grids(type, FacetType::quad4, 0.05);
    const Scene full(grids, effects_of(false, 0));
    const PerSide<Matrix3Xd> x = full.position();
    BOOST_TEST((pass_of(full).coverage(x[Side::primary], x[Side::secondary]).array() - 1).abs().maxCoeff() <= rounding);
    grids[Side::secondary].high[0] = 0.5;  // one of two columns of cells
    const Scene half(grids, effects_of(false, 0));
    const VectorXd coverage = pass_of(half).coverage(x[Side::primary], half.fields[Side::secondary].position);
    for (Index node = 0; node < coverage.size(); ++node) {
      const double place = x[Side::primary](0, node);
      if (place < 0.49) BOOST_TEST(std::abs(coverage[node] - 1) <= rounding);
      if (place > 0.51) BOOST_TEST(coverage[node] == 0.0);
    }
    grids[Side::secondary].z = 0.1;
    const Scene apart(grids, effects_of(false, 0));
    BOOST_TEST(pass_of(apart).coverage(x[Side::primary], apart.fields[Side::secondary].position).norm() == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(the_symmetric_option_gives_symmetric_tangents) {
  std::mt19937 random(4);
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad8, 0.05), effects_of(true, 1));
  scene.disturb(0.02, random);
  for (const bool symmetric : {true, false}) {
    scene.settings.symmetric = symmetric;
    int handed_out = 0;
    tangent_of(pass_of(scene), scene, [&](const FacetPair&, const MatrixXd& tangent) {
      ++handed_out;
      BOOST_TEST((tangent == tangent.transpose()) == symmetric);
    });
    BOOST_TEST(handed_out > 0);
  }
}

BOOST_AUTO_TEST_CASE(growth_multiplies_the_penalties) {
  const Scene scene = overlapping_squares();
  ContactPass pass = pass_of(scene);
  pass.multipliers.traction_growth = 2;
  pass.multipliers.flux_growth << 4, 8, 16;
  VectorXd sum = VectorXd::Zero(6);
  residual_of(pass, scene, [&](const FacetPair& pair, const VectorXd& r) { sum += primary_sum(pair, r); });
  VectorXd expected(6);
  expected << 0, 0, -0.25 * 2, dt * 0.5 * 4, dt * 4 * 8, dt * -16 * 16;
  BOOST_TEST((sum - expected).norm() <= rounding * expected.norm());
}

BOOST_AUTO_TEST_CASE(a_zero_penalty_carries_nothing) {
  Scene scene = overlapping_squares();
  scene.settings = explicit_settings(0, 0, 0);
  BOOST_TEST(contacts(pass_of(scene), scene) == 0);
  scene.settings = explicit_settings(1, 0, 0);
  residual_of(pass_of(scene), scene, [](const FacetPair& pair, const VectorXd& residual) {
    BOOST_TEST(primary_sum(pair, residual).tail(3).norm() == 0.0);
    BOOST_TEST(residual.norm() > 0.0);
  });
}
