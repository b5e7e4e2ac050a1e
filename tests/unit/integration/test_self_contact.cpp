#include "contact/integration/self_contact.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>

using namespace test;

namespace {

constexpr double dt = 0.25;
constexpr double thickness = 0.25;

/// Two surfaces as one; nodes and facets of the second follow those of the first.
GridSurface joined(const GridSurface& one, const GridSurface& two) {
  GridSurface both = one;
  for (Facet facet : two.mesh.facets) {
    for (int& node : facet.nodes) node += one.mesh.nodes;
    both.mesh.facets.push_back(facet);
  }
  both.mesh.nodes += two.mesh.nodes;
  const auto facets = both.mesh.facets.count();
  both.mesh.permeable.assign(both.mesh.facets.size(), ~FieldMask{0});
  both.mesh.stiffness = VectorXd::Constant(facets, one.mesh.stiffness[0]);
  both.mesh.conductance = MatrixXd::Constant(one.mesh.conductance.rows(), facets, 1);
  both.position.resize(3, both.mesh.nodes);
  both.position << one.position, two.position;
  return both;
}

/// Marks a surface as one whose body may be in contact with itself.
void meet_itself(SurfaceMesh& mesh) {
  mesh.node_ids.clear();
  for (int node = 0; node < mesh.nodes; ++node) mesh.node_ids.push_back(node);
  mesh.thickness = VectorXd::Constant(mesh.facets.count(), thickness);
}

/// The scene of two surfaces, and the same scene with both surfaces together on either side.
struct Both {
  Scene apart;
  Scene self;

  explicit Both(double overlap, Integration integration = Integration::gauss)
      : apart(facing_grids(FacetType::quad4, FacetType::quad4, overlap, 2, 3), effects_of(true, 1),
              explicit_settings(4, 2, 8)),
        self(apart) {
    apart.settings.integration = self.settings.integration = integration;
    apart.settings.two_pass = true;
    std::mt19937 random(7);
    apart.disturb(0.01, random);
    const GridSurface whole = joined({apart.mesh[Side::primary], apart.fields[Side::primary].position},
                                     {apart.mesh[Side::secondary], apart.fields[Side::secondary].position});
    MatrixXd scalar(whole.mesh.nodes, 2);
    scalar << apart.fields[Side::primary].scalar, apart.fields[Side::secondary].scalar;
    for (const Side side : both_sides) {
      self.mesh[side] = whole.mesh;
      meet_itself(self.mesh[side]);
      self.fields[side] = {whole.position, scalar};
    }
  }
};

/// The assembled residual, summed over the same nodes of both sides.
VectorXd added_up(const Scene& scene) {
  const VectorXd residual = assembled_residual(*scene.contact(), GlobalLayout(scene), scene.fields, dt);
  return residual.head(residual.size() / 2) + residual.tail(residual.size() / 2);
}

std::size_t pairs(const Scene& scene) { return scene.contact()->pass(0).pairs().size(); }

/// A strip along x, one cell wide, that is folded upwards in the middle such that its halves meet at an angle.
Scene folded_strip(int cells, double angle, Integration integration) {
  Grid grid{FacetType::quad4, cells, 1, {-1, 0}, {1, 1}};
  Settings settings = explicit_settings(4, 2, 8);
  settings.integration = integration;
  Scene scene({{grid, grid}}, effects_of(false, 0), settings);
  for (const Side side : both_sides) {
    meet_itself(scene.mesh[side]);
    for (auto x : scene.fields[side].position.colwise()) {
      const double along = std::abs(x[0]);
      x[2] = along * std::cos(angle / 2);
      x[0] = std::copysign(along * std::sin(angle / 2), x[0]);
    }
  }
  return scene;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_surface_with_itself_does_what_two_passes_do_for_its_parts) {
  for (const Integration integration : {Integration::gauss, Integration::segments}) {
    const Both both(0.0625, integration);
    const VectorXd expected = assembled_residual(*both.apart.contact(), GlobalLayout(both.apart), both.apart.fields,
                                                 dt);
    const VectorXd found = added_up(both.self);
    BOOST_TEST_REQUIRE(found.size() == expected.size());
    BOOST_TEST(expected.cwiseAbs().maxCoeff() > 0);
    BOOST_TEST((found - expected).cwiseAbs().maxCoeff() <= rounding * expected.cwiseAbs().maxCoeff());
  }
}

BOOST_AUTO_TEST_CASE(the_far_side_of_its_own_body_is_not_seen) {
  for (const Integration integration : {Integration::gauss, Integration::segments}) {
    BOOST_TEST(pairs(Both(0.4 * thickness, integration).self) > 0);
    BOOST_TEST(pairs(Both(thickness, integration).self) == 0);
    BOOST_TEST(pairs(Both(thickness, integration).apart) > 0);
  }
}

BOOST_AUTO_TEST_CASE(nodes_do_not_face_the_far_side_either) {
  for (const double overlap : {0.4 * thickness, thickness}) {
    const PerSide<NodeFlags> in_contact = Both(overlap).self.contact()->nodes_in_contact();
    for (const Side side : both_sides)
      BOOST_TEST(std::count(in_contact[side].begin(), in_contact[side].end(), true) ==
                 (overlap < thickness / 2 ? in_contact[side].count() : 0));
  }
}

BOOST_AUTO_TEST_CASE(facets_that_share_a_node_do_not_see_each_other) {
  constexpr double sharp = 0.5;
  for (const Integration integration : {Integration::gauss, Integration::segments}) {
    // Only facets that do not touch the fold have pairs, with others that do not touch it.
    BOOST_TEST(pairs(folded_strip(2, sharp, integration)) == 0);
    const Scene strip = folded_strip(4, sharp, integration);
    const auto contact = strip.contact();
    for (const FacetPair& pair : contact->pass(0).pairs()) {
      const Facet& one = strip.mesh[Side::primary].facets[pair.primary];
      const Facet& two = strip.mesh[Side::secondary].facets[pair.secondary];
      for (const int node : one) BOOST_TEST(std::count(two.begin(), two.end(), node) == 0);
    }
    BOOST_TEST(!contact->pass(0).pairs().empty());
  }
}

BOOST_AUTO_TEST_CASE(a_flat_surface_does_not_see_itself) {
  for (const Integration integration : {Integration::gauss, Integration::segments}) {
    constexpr double flat = 3.14159;
    BOOST_TEST(pairs(folded_strip(6, flat, integration)) == 0);
  }
}

BOOST_AUTO_TEST_CASE(self_contact_has_no_penetration_check) {
  const Both both(0.0625);
  const auto contact = both.self.contact();
  contact->begin_iteration(both.self.fields);
  BOOST_TEST(contact->check_penetration(both.self.fields).nodes == 0);
  BOOST_TEST(contact->passes() == 1U);
}

BOOST_AUTO_TEST_CASE(facets_at_nearly_a_right_angle_do_not_face_each_other) {
  constexpr double degree = 3.14159265358979 / 180;
  for (const Integration integration : {Integration::gauss, Integration::segments}) {
    BOOST_TEST(pairs(folded_strip(6, 55 * degree, integration)) > 0);
    BOOST_TEST(pairs(folded_strip(6, 65 * degree, integration)) == 0);
  }
}
