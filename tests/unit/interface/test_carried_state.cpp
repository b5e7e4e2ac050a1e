#include "contact/interface/carried_state.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <numeric>
#include <utility>

using namespace test;

namespace {

/// A contact with friction, whose state has values at all nodes.
Scene rubbing_scene(unsigned seed = 5) {
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.05, 3, 2), effects_of(true, 1),
              explicit_settings(3, 2, 5));
  scene.settings.friction.coefficient = 0.3;
  scene.effects.friction_kind = FrictionKind::on_traction;
  std::mt19937 random(seed);
  scene.disturb(0.01, random);
  return scene;
}

/// Numbers of the nodes in the mesh of a host, different from those on the surface.
IndexedVector<int> numbers(int nodes, int first) {
  IndexedVector<int> all(nodes);
  std::iota(all.begin(), all.end(), first);
  return all;
}

NodeNumbers numbers_of(const Scene& scene) {
  return {{numbers(scene.mesh[Side::primary].nodes, 100), numbers(scene.mesh[Side::secondary].nodes, 7)}};
}

/// Removes the first facet of the primary surface, with the nodes that no other facet has.
Scene without_first_facet(const Scene& scene, NodeNumbers& numbers) {
  Scene left = scene;
  SurfaceMesh& mesh = left.mesh[Side::primary];
  mesh.facets.erase(mesh.facets.begin());
  mesh.permeable.pop_back();
  mesh.stiffness.conservativeResize(mesh.facets.count());
  mesh.conductance.conservativeResize(Eigen::NoChange, mesh.facets.count());
  IndexedVector<int> place(mesh.nodes, -1);
  IndexedVector<int> kept;
  for (Facet& facet : mesh.facets) {
    for (Index a = 0; a < facet.count(); ++a) {
      int& node = facet.nodes[static_cast<std::size_t>(a)];
      if (place[node] < 0) {
        place[node] = static_cast<int>(kept.count());
        kept.push_back(node);
      }
      node = place[node];
    }
  }
  mesh.nodes = static_cast<int>(kept.count());
  SurfaceFields& fields = left.fields[Side::primary];
  const SurfaceFields before = fields;
  fields.position.resize(3, mesh.nodes);
  fields.scalar.resize(mesh.nodes, before.scalar.cols());
  IndexedVector<int> found;
  for (Index node = 0; node < kept.count(); ++node) {
    fields.position.col(node) = before.position.col(kept[node]);
    fields.scalar.row(node) = before.scalar.row(kept[node]);
    found.push_back(numbers[Side::primary][kept[node]]);
  }
  numbers[Side::primary] = std::move(found);
  return left;
}

NumberedState accepted_state(const Scene& scene, const NodeNumbers& numbers) {
  const auto contact = scene.contact();
  contact->augment(scene.fields);
  contact->accept_step(scene.fields);
  return {numbers, contact->state()};
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_state_of_the_same_nodes_stays) {
  const Scene scene = rubbing_scene();
  const NumberedState before = accepted_state(scene, numbers_of(scene));
  const ContactInterface::State after = carried_over(before, {before.nodes, scene.contact()->state()},
                                                     scene.position());
  const Multipliers& one = before.state.multipliers.front();
  const Multipliers& two = after.multipliers.front();
  BOOST_TEST((one.traction == two.traction));
  BOOST_TEST((one.flux == two.flux));
  BOOST_TEST((one.accepted_traction == two.accepted_traction));
  BOOST_TEST((one.friction == two.friction));
  BOOST_TEST((one.slips == two.slips));
  BOOST_TEST((one.flux_coupled == two.flux_coupled));
  BOOST_TEST((before.state.slips_from == after.slips_from));
  BOOST_TEST(one.traction.norm() > 0);
  BOOST_TEST(one.friction.norm() >= 0);
}

BOOST_AUTO_TEST_CASE(nodes_that_are_left_keep_theirs_under_new_indices) {
  const Scene scene = rubbing_scene();
  NodeNumbers now = numbers_of(scene);
  const NumberedState before = accepted_state(scene, now);
  const Scene left = without_first_facet(scene, now);
  BOOST_TEST(left.mesh[Side::primary].nodes < scene.mesh[Side::primary].nodes);
  const auto contact = left.contact();
  const ContactInterface::State after = carried_over(before, {now, contact->state()}, left.position());
  for (Index node = 0; node < now[Side::primary].count(); ++node) {
    const Index source = now[Side::primary][node] - 100;
    const Multipliers& from = before.state.multipliers.front();
    const Multipliers& to = after.multipliers.front();
    BOOST_TEST(to.traction[node] == from.traction[source]);
    BOOST_TEST((to.flux.col(node) == from.flux.col(source)));
    BOOST_TEST((to.friction.col(node) == from.friction.col(source)));
    BOOST_TEST((after.slips_from[Side::primary].col(node) == before.state.slips_from[Side::primary].col(source)));
  }
  contact->restore(after);  // throws if the state does not fit
}

BOOST_AUTO_TEST_CASE(nodes_that_are_new_begin_as_in_a_new_contact) {
  const Scene scene = rubbing_scene();
  const NodeNumbers all = numbers_of(scene);
  NodeNumbers fewer = all;
  const Scene left = without_first_facet(scene, fewer);
  const NumberedState before = accepted_state(left, fewer);
  const auto contact = scene.contact();
  const NumberedState fresh{all, contact->state()};
  const ContactInterface::State after = carried_over(before, fresh, scene.position());
  for (Index node = 0; node < all[Side::primary].count(); ++node) {
    if (position_in(fewer[Side::primary], all[Side::primary][node]) < fewer[Side::primary].count()) continue;
    BOOST_TEST(after.multipliers.front().traction[node] == 0);
    BOOST_TEST((after.slips_from[Side::primary].col(node) == scene.fields[Side::primary].position.col(node)));
  }
  contact->restore(after);
}

BOOST_AUTO_TEST_CASE(of_other_fields_nothing_is_kept) {
  const Scene scene = rubbing_scene();
  const NumberedState before = accepted_state(scene, numbers_of(scene));
  const Scene other(facing_grids(FacetType::quad4, FacetType::quad4, 0.05, 3, 2), effects_of(false, 0),
                    explicit_settings(3, 2, 5));
  const auto contact = other.contact();
  const ContactInterface::State after = carried_over(before, {before.nodes, contact->state()}, other.position());
  BOOST_TEST(after.multipliers.front().traction.norm() == 0);
  contact->restore(after);
}
