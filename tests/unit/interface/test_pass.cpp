#include "contact/interface/pass.h"

#include "contact/geometry/quadrature.h"
#include "contact/mortar/loaded_points.h"
#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <bitset>
#include <map>
#include <set>

using namespace test;

namespace {

constexpr double dt = 0.25;

/// A pass over the primary surface of a scene, after a projection.
class ProjectedPass : public ContactPass {
 public:
  explicit ProjectedPass(const Scene& scene, double radius = 1)
      : ContactPass(scene.mesh[Side::primary], scene.mesh[Side::secondary], scene.effects, scene.settings) {
    project(positions(seen_from(Side::primary, scene.fields)), radius);
  }
};

void residual_of(const ContactPass& pass, const Scene& scene,
                 const std::function<void(const Patch&, const VectorXd&)>& use) {
  pass.geometry().residual(seen_from(Side::primary, scene.fields), dt, use);
}

void tangent_of(const ContactPass& pass, const Scene& scene, const std::function<void(const TangentBlock&)>& use) {
  pass.geometry().tangent(seen_from(Side::primary, scene.fields), dt, {use, {}, {}});
}

/// The number of integration points that have a pair.
Index points(const ContactPass& pass) {
  Index count = 0;
  for (const FacetPair& pair : pass.pairs()) count += pair.points;
  return count;
}

/// The number of integration points of the primary surface.
Index all_points(const Scene& scene) {
  Index count = 0;
  for (const Facet& facet : scene.mesh[Side::primary].facets) {
    count += static_cast<Index>(quadrature(facet.type, default_quadrature_order(facet.type)).size());
  }
  return count;
}

/// Calls use(contact) for every point in contact.
template <class Use>
void for_each_contact(const ContactPass& pass, const Scene& scene, const Use& use) {
  const FacingFields fields = seen_from(Side::primary, scene.fields);
  const NodalLoads loads = pass.nodal_loads(fields);
  for (const FacetPair& pair : pass.pairs()) {
    if (!pass.space().facing().has_node_among(pair, loads.in_contact)) continue;
    for_each_loaded_point(pass.space(), pair, loads, fields, dt, use);
  }
}

/// The number of integration points in contact.
int contacts(const ContactPass& pass, const Scene& scene) {
  int count = 0;
  for_each_contact(pass, scene, [&](const PointContact&) { ++count; });
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

/// Sum of a residual over the primary nodes: force, then the flow of each local field times dt.
VectorXd primary_sum(const Patch& patch, const VectorXd& residual) {
  VectorXd sum = VectorXd::Zero(patch.layout().per_node());
  for (Index a = 0; a < patch.layout().primary_nodes(); ++a) {
    for (Index i = 0; i < 3; ++i) sum[i] += residual[patch.layout().displacement(a, i)];
    for (Index k = 0; k < patch.layout().scalar_fields(); ++k) sum[3 + k] += residual[patch.layout().scalar(a, k)];
  }
  return sum;
}

/// An unknown: the number of its node (secondary nodes count from -1 downwards), and -1 for displacements or the number
/// of its field.
using Unknown = std::pair<int, int>;

std::vector<Unknown> unknowns(const Patch& patch) {
  std::vector<int> nodes = patch.primary;
  for (const int node : patch.secondary) nodes.push_back(-1 - node);
  std::vector<Unknown> all;
  for (const int node : nodes) {
    if (patch.displacements) all.emplace_back(node, -1);
    for (const int field : patch.fields) all.emplace_back(node, field);
  }
  return all;
}

/// Adds all couplings between the unknowns of `rows` and those of `columns`.
void add_couplings(std::set<std::pair<Unknown, Unknown>>& couplings, const Patch& rows, const Patch& columns) {
  for (const Unknown& one : unknowns(rows)) {
    for (const Unknown& two : unknowns(columns)) couplings.insert({one, two});
  }
}

/// Primary and secondary nodes of the pairs of a pass, by the exchanged fields of the pairs.
std::map<std::vector<int>, std::pair<std::set<int>, std::set<int>>> nodes_by_fields(const ContactPass& pass,
                                                                                    const Scene& scene) {
  const SurfaceMesh& primary = scene.mesh[Side::primary];
  const SurfaceMesh& secondary = scene.mesh[Side::secondary];
  std::map<std::vector<int>, std::pair<std::set<int>, std::set<int>>> found;
  for (const FacetPair& pair : pass.pairs()) {
    const FieldMask both = primary.permeable[pair.primary] & secondary.permeable[pair.secondary];
    auto& nodes = found[fields_in(both, scene.effects.scalar_fields())];
    for (const int node : primary.facets[pair.primary]) nodes.first.insert(node);
    for (const int node : secondary.facets[pair.secondary]) nodes.second.insert(node);
  }
  return found;
}

}  // namespace

BOOST_AUTO_TEST_CASE(points_follow_the_integration_order) {
  Scene scene = overlapping_squares(FacetType::quad4, FacetType::tri6);
  BOOST_TEST(points(ProjectedPass(scene)) == 4 * 4);
  scene.settings.integration_order = 3;
  BOOST_TEST(points(ProjectedPass(scene)) == 4 * 9);
  scene = overlapping_squares(FacetType::tri6);
  BOOST_TEST(points(ProjectedPass(scene)) == 8 * 7);
}

BOOST_AUTO_TEST_CASE(every_point_of_facing_surfaces_finds_the_point_opposite) {
  for (const auto& [one, two] : facet_pairs()) {
    const Scene scene = overlapping_squares(one, two);
    const ProjectedPass pass(scene);
    BOOST_TEST(points(pass) == all_points(scene));
    int found = 0;
    for_each_contact(pass, scene, [&](const PointContact& contact) {
      ++found;
      BOOST_TEST(std::abs(contact.kinematics.gap + 0.0625) <= rounding);
      BOOST_TEST((contact.kinematics.normal - Vector3d(0, 0, 1)).norm() <= rounding);
    });
    BOOST_TEST(found == all_points(scene));
  }
}

BOOST_AUTO_TEST_CASE(a_uniform_overlap_and_jump_give_their_exact_force_and_flows) {
  for (const auto& [one, two] : facet_pairs()) {
    const Scene scene = overlapping_squares(one, two);
    VectorXd sum = VectorXd::Zero(6);
    residual_of(ProjectedPass(scene), scene,
                [&](const Patch& patch, const VectorXd& r) { sum += primary_sum(patch, r); });
    // The area is 1; t_n = -4/16 along +z; w = 2 (1/2 - 1/4); j = 8 (1 - 1/2) and 8 (0 - 2).
    VectorXd expected(6);
    expected << 0, 0, -0.25, dt * 0.5, dt * 4, dt * -16;
    BOOST_TEST((sum - expected).norm() <= rounding * expected.norm());
  }
}

BOOST_AUTO_TEST_CASE(tangents_stay_within_the_profile) {
  std::mt19937 random(1);
  Scene scene(facing_grids(FacetType::quad4, FacetType::tri3, 0.05, 3, 4), effects_of(true, 1));
  scene.disturb(0.03, random);
  const ProjectedPass pass(scene);
  std::set<std::pair<Unknown, Unknown>> profile;
  std::set<std::pair<Unknown, Unknown>> filled;
  pass.geometry().for_each_coupling({[&](const Patch& patch) { add_couplings(profile, patch, patch); }, {}, {}});
  tangent_of(pass, scene, [&](const TangentBlock& block) {
    BOOST_TEST(block.values.rows() == block.rows.layout().size());
    BOOST_TEST(block.values.cols() == block.columns.layout().size());
    add_couplings(filled, block.rows, block.columns);
  });
  BOOST_TEST(!filled.empty());
  BOOST_TEST(std::includes(profile.begin(), profile.end(), filled.begin(), filled.end()));
}

BOOST_AUTO_TEST_CASE(fields_that_one_side_does_not_know_are_not_there) {
  constexpr int fields = 5;
  std::mt19937 random(2);
  for (int sample = 0; sample < 20; ++sample) {
    Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.05, 2, 3),
                effects_of(sample % 2 == 0, fields - sample % 2));
    scene.disturb(0.01, random);
    for (const Side side : both_sides) {
      for (FieldMask& mask : scene.mesh[side].permeable) mask = random() % (FieldMask{1} << unsigned{fields});
    }
    const ProjectedPass pass(scene);
    auto expected = nodes_by_fields(pass, scene);
    BOOST_TEST(expected.size() > 1U);
    std::set<int> known;
    // Each node comes once for each set of fields that pairs around it exchange.
    residual_of(pass, scene, [&](const Patch& patch, const VectorXd& residual) {
      const auto [primary, secondary] = expected.at(patch.fields);
      BOOST_TEST(patch.primary == std::vector<int>(primary.begin(), primary.end()));
      BOOST_TEST(patch.secondary == std::vector<int>(secondary.begin(), secondary.end()));
      expected.erase(patch.fields);
      known.insert(patch.fields.begin(), patch.fields.end());
      BOOST_TEST(residual.size() == patch.layout().nodes() * (3 + static_cast<Index>(patch.fields.size())));
    });
    // The tangent of a node's laws couples all facets around the node, and therefore all fields that any of their pairs
    // exchanges.
    tangent_of(pass, scene, [&](const TangentBlock& block) {
      for (const int field : block.rows.fields) BOOST_TEST(known.count(field) == 1U);
      BOOST_TEST(block.columns.fields == block.rows.fields);
    });
    BOOST_TEST(expected.empty());
  }
}

BOOST_AUTO_TEST_CASE(the_flow_of_a_field_does_not_depend_on_its_place_or_on_the_other_fields) {
  std::mt19937 random(3);
  constexpr int fields = 4;
  Scene scene(facing_grids(FacetType::quad8, FacetType::tri3, 0.05), effects_of(false, fields));
  scene.disturb(0.01, random);
  const std::array<int, 3> chosen{2, 0, 3};  // number of field k of the other scene in the first one
  Scene part(facing_grids(FacetType::quad8, FacetType::tri3, 0.05), effects_of(false, 3));
  for (const Side side : both_sides) {
    part.fields[side].position = scene.fields[side].position;
    for (Index k = 0; k < 3; ++k) {
      part.fields[side].scalar.col(k) = scene.fields[side].scalar.col(chosen[static_cast<std::size_t>(k)]);
    }
  }
  std::vector<VectorXd> whole;
  residual_of(ProjectedPass(scene), scene, [&](const Patch&, const VectorXd& residual) { whole.push_back(residual); });
  std::size_t next = 0;
  residual_of(ProjectedPass(part), part, [&](const Patch& patch, const VectorXd& residual) {
    BOOST_REQUIRE(next < whole.size());
    const LocalLayout layout(patch.layout().primary_nodes(), patch.layout().nodes() - patch.layout().primary_nodes(),
                             fields);
    for (Index node = 0; node < layout.nodes(); ++node) {
      for (Index k = 0; k < 3; ++k) {
        const Index same = layout.scalar(node, chosen[static_cast<std::size_t>(k)]);
        BOOST_TEST(residual[patch.layout().scalar(node, k)] == whole[next][same]);
      }
    }
    ++next;
  });
  BOOST_TEST(next == whole.size());
}

BOOST_AUTO_TEST_CASE(a_field_keeps_its_own_values_penalty_and_multiplier_where_others_are_missing) {
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.0625), effects_of(true, 3));
  scene.settings.solvent = scene.settings.solute = {true, 2};
  const Vector2d jumps(0.5, -4);
  scene.set_field(1, 0.75, 0.25);
  scene.set_field(3, 1, 5);
  for (const Side side : both_sides) {
    for (Index k = 0; k < 4; ++k) scene.mesh[side].conductance.row(k).setConstant(1 << k);
  }
  for (FieldMask& mask : scene.mesh[Side::secondary].permeable) mask = only(1) | only(3);
  ProjectedPass pass(scene);
  for (Index k = 0; k < 4; ++k) pass.laws().multipliers.flux.row(k).setConstant(100 * static_cast<double>(k + 1));
  VectorXd sum = VectorXd::Zero(5);
  residual_of(pass, scene, [&](const Patch& patch, const VectorXd& r) { sum += primary_sum(patch, r); });
  const Vector2d expected = dt * (Vector2d(200, 400) + 2 * Vector2d(2, 8).cwiseProduct(jumps));
  BOOST_TEST((sum.tail<2>() - expected).norm() <= rounding * expected.norm());
}

BOOST_AUTO_TEST_CASE(as_many_fields_as_a_mask_holds_are_exchanged) {
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.05, 1, 1), effects_of(true, max_scalar_fields - 1),
              explicit_settings(1, 2, 3));
  for (Index k = 0; k < max_scalar_fields; ++k) scene.set_field(k, static_cast<double>(k), 0);
  residual_of(ProjectedPass(scene), scene, [](const Patch& patch, const VectorXd& residual) {
    const VectorXd sum = primary_sum(patch, residual);
    for (Index k = 0; k < max_scalar_fields; ++k) {
      const double flow = dt * (k == 0 ? 2.0 : 3.0) * static_cast<double>(k);
      BOOST_TEST(std::abs(sum[3 + k] - flow) <= rounding * (1 + flow));
    }
  });
}

BOOST_AUTO_TEST_CASE(surfaces_that_touch_are_in_contact_and_those_apart_are_not) {
  for (const double gap : {0.0, 1e-14, 1e-3, 0.5}) {
    const Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, -gap), effects_of(true, 1));
    const ProjectedPass pass(scene);
    BOOST_TEST(points(pass) == all_points(scene));
    BOOST_TEST(contacts(pass, scene) == (gap < 1e-10 ? all_points(scene) : 0));
    residual_of(pass, scene, [](const Patch&, const VectorXd& residual) { BOOST_TEST(residual.norm() == 0.0); });
  }
}

BOOST_AUTO_TEST_CASE(facets_farther_than_the_radius_are_not_seen) {
  const Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, -0.5), effects_of(false, 0));
  BOOST_TEST(points(ProjectedPass(scene, 0.6)) == 16);
  BOOST_TEST(ProjectedPass(scene, 0.4).pairs().empty());
}

BOOST_AUTO_TEST_CASE(points_beside_the_other_surface_are_not_in_contact) {
  PerSide<Grid> grids = facing_grids(FacetType::quad4, FacetType::quad4, 0.05);
  grids[Side::secondary].high[0] = 0.5;
  Scene scene(grids, effects_of(false, 0));
  scene.settings.integration = Integration::gauss;
  BOOST_TEST(points(ProjectedPass(scene)) == 8);
}

BOOST_AUTO_TEST_CASE(the_symmetric_option_gives_symmetric_tangents) {
  std::mt19937 random(4);
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad8, 0.05), effects_of(true, 1));
  scene.disturb(0.02, random);
  for (const bool symmetric : {true, false}) {
    scene.settings.symmetric = symmetric;
    int handed_out = 0;
    tangent_of(ProjectedPass(scene), scene, [&](const TangentBlock& block) {
      ++handed_out;
      const MatrixXd& tangent = block.values;
      const bool is_symmetric = tangent.rows() == tangent.cols() &&
                                relative_error(tangent, tangent.transpose()) <= rounding;
      BOOST_TEST(is_symmetric == symmetric);
    });
    BOOST_TEST(handed_out > 0);
  }
}

BOOST_AUTO_TEST_CASE(growth_multiplies_the_penalties) {
  const Scene scene = overlapping_squares();
  ProjectedPass pass(scene);
  pass.laws().multipliers.traction_penalty_scale = 2;
  pass.laws().multipliers.flux_penalty_scale << 4, 8, 16;
  VectorXd sum = VectorXd::Zero(6);
  residual_of(pass, scene, [&](const Patch& patch, const VectorXd& r) { sum += primary_sum(patch, r); });
  VectorXd expected(6);
  expected << 0, 0, -0.25 * 2, dt * 0.5 * 4, dt * 4 * 8, dt * -16 * 16;
  BOOST_TEST((sum - expected).norm() <= rounding * expected.norm());
}

BOOST_AUTO_TEST_CASE(a_zero_penalty_carries_nothing) {
  Scene scene = overlapping_squares();
  scene.settings = explicit_settings(0, 0, 0);
  BOOST_TEST(contacts(ProjectedPass(scene), scene) == 0);
  scene.settings = explicit_settings(1, 0, 0);
  residual_of(ProjectedPass(scene), scene, [](const Patch& patch, const VectorXd& residual) {
    BOOST_TEST(primary_sum(patch, residual).tail(3).norm() == 0.0);
    BOOST_TEST(residual.norm() > 0.0);
  });
}
