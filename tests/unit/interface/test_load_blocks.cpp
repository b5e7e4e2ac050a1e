/// Tests of tangents of nodal loads as products of two vectors: the same tangent with fewer couplings.
#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

using namespace test;

namespace {

constexpr double dt = 0.25;
using Location = ContactInterface::Location;
using Entry = std::pair<Index, Index>;

/// Overlapping, disturbed surfaces, such that geometric parts are not zero.
Scene overlapping(const Effects& effects, FacetType type, const Settings& settings = {}) {
  std::mt19937 random(1);
  Scene scene(facing_grids(type, FacetType::tri3, 0.2, 3, 2), effects, settings);
  scene.disturb(0.03, random);
  return scene;
}

Scene two_pass() {
  Settings settings;
  settings.two_pass = true;
  return overlapping(effects_of(true, 1), FacetType::quad4, settings);
}

Scene fixed() {
  Scene scene = overlapping(effects_of(true, 2), FacetType::quad4);
  scene.effects.traction = false;
  return scene;
}

std::vector<Scene> scenes() {
  return {overlapping(effects_of(false, 0), FacetType::quad4), overlapping(effects_of(true, 1), FacetType::tri3),
          overlapping(effects_of(true, 2), FacetType::tri6), two_pass(), fixed()};
}

/// The parts of a tangent.
struct Parts {
  MatrixXd blocks;    ///< sum of the blocks
  MatrixXd products;  ///< sum of the products of load blocks
  std::size_t loads;
  std::set<Entry> entries;  ///< entries that the blocks fill
};

Parts parts_of(const Scene& scene, const ContactInterface& contact) {
  const GlobalLayout layout(scene);
  const Index size = layout.size() + 1;
  Parts parts{MatrixXd::Zero(size, size), MatrixXd::Zero(size, size), 0, {}};
  contact.tangent(
      scene.fields, dt,
      [&](const Location& rows, const Location& columns, const MatrixXd& values) {
        parts.blocks(layout.entries(rows), layout.entries(columns)) += values;
        for (const Index row : layout.entries(rows)) {
          for (const Index column : layout.entries(columns)) parts.entries.emplace(row, column);
        }
      },
      [&](Side first, const LoadBlock& load) {
        parts.products(layout.entries({first, load.rows}),
                       layout.entries({first, load.place.columns})) += load.factor * load.work *
                                                                       load.variation.transpose();
        ++parts.loads;
      });
  return parts;
}

void insert(std::set<Entry>& entries, const GlobalLayout& layout, const Location& rows, const Location& columns) {
  for (const Index row : layout.entries(rows)) {
    for (const Index column : layout.entries(columns)) entries.emplace(row, column);
  }
}

/// A tangent with the geometric part by nodes and the products of load blocks.
struct RowsAndRest {
  MatrixXd sum;
  std::set<Entry> by_rows;  ///< entries that the rows fill
  Index rows = 0;           ///< number of rows
};

RowsAndRest rows_and_rest(const Scene& scene, const ContactInterface& contact) {
  const GlobalLayout layout(scene);
  const Index size = layout.size() + 1;
  RowsAndRest parts{MatrixXd::Zero(size, size), {}};
  const auto add = [&](const Location& rows, const Location& columns, const MatrixXd& values) {
    parts.sum(layout.entries(rows), layout.entries(columns)) += values;
  };
  contact.tangent(scene.fields, dt, add, {}, [&](Side first, const IndexedVector<TangentBlock>& rows, double factor) {
    for (const TangentBlock& row : rows) {
      add({first, row.rows}, {first, row.columns}, factor * row.values);
      insert(parts.by_rows, layout, {first, row.rows}, {first, row.columns});
    }
    parts.rows += rows.count();
  });
  return parts;
}

/// The couplings of a contact: of blocks, and of loads by surface, node and field (-1 for the traction).
struct Coupled {
  std::set<Entry> entries;
  std::map<std::tuple<Side, int, int>, std::set<Index>> loads;
};

std::tuple<Side, int, int> name_of(Side first, const LoadPlace& load) {
  return {first, load.node, load.field.value_or(-1)};
}

Coupled coupled(const Scene& scene, const ContactInterface& contact) {
  const GlobalLayout layout(scene);
  Coupled found;
  contact.for_each_coupling(
      [&](const Location& at) {
        for (const Index row : layout.entries(at)) {
          for (const Index column : layout.entries(at)) found.entries.emplace(row, column);
        }
      },
      [&](Side first, const LoadPlace& load) {
        for (const Index entry : layout.entries({first, load.columns})) found.loads[name_of(first, load)].insert(entry);
      });
  return found;
}

/// Calls use(scene, contact) for each scene, before the iterations and in an iteration.
template <class Use>
void for_each_state(const Use& use) {
  for (const Scene& scene : scenes()) {
    const auto contact = scene.contact();
    use(scene, *contact);
    contact->begin_iteration(scene.fields);
    use(scene, *contact);
  }
}

/// The entries between the nodes of facing facets.
std::set<Entry> of_facing_facets(const Scene& scene, const ContactInterface& contact) {
  const GlobalLayout layout(scene);
  std::set<Entry> entries;
  for (std::size_t pass = 0; pass < contact.passes(); ++pass) {
    const Side first = pass == 0 ? Side::primary : Side::secondary;
    for (const FacetPair& pair : contact.pass(pass).pairs()) {
      const Patch patch = patch_of(contact.pass(pass).space().facing(), pair);
      for (const Index row : layout.entries({first, patch})) {
        for (const Index column : layout.entries({first, patch})) entries.emplace(row, column);
      }
    }
  }
  return entries;
}

}  // namespace

BOOST_AUTO_TEST_CASE(blocks_and_products_add_up_to_the_tangent) {
  for_each_state([](const Scene& scene, const ContactInterface& contact) {
    const Parts parts = parts_of(scene, contact);
    const GlobalLayout layout(scene);
    const MatrixXd sum = (parts.blocks + parts.products).topLeftCorner(layout.size(), layout.size());
    BOOST_TEST(parts.loads > 0U);
    BOOST_TEST(parts.products.norm() > 0);
    BOOST_TEST(relative_error(sum, assembled_tangent(contact, layout, scene.fields, dt)) <= rounding);
  });
}

BOOST_AUTO_TEST_CASE(rows_and_the_rest_add_up_to_the_tangent_with_friction) {
  for (const Effects& effects : {effects_of(false, 0), effects_of(true, 1)}) {
    Scene scene = overlapping(effects, FacetType::tri3);
    scene.effects.friction_kind = FrictionKind::on_traction;
    scene.settings.friction.coefficient = 0.3;
    const auto contact = scene.contact();
    contact->begin_iteration(scene.fields);
    const GlobalLayout layout(scene);
    const RowsAndRest parts = rows_and_rest(scene, *contact);
    BOOST_TEST(parts.rows > 0);
    const MatrixXd sum = parts.sum.topLeftCorner(layout.size(), layout.size());
    BOOST_TEST(relative_error(sum, assembled_tangent(*contact, layout, scene.fields, dt)) <= rounding);
  }
}

BOOST_AUTO_TEST_CASE(couplings_hold_what_rows_and_the_rest_fill) {
  std::vector<Scene> all = scenes();
  for (const bool exchanges : {false, true}) {  // nodes around a load that are not coupled with each other
    all.push_back(overlapping(effects_of(exchanges, exchanges ? 1 : 0), FacetType::quad4));
    all.back().settings.enforcement = Enforcement::lagrange_multipliers;
  }
  for (const Scene& scene : all) {
    const auto contact = scene.contact();
    contact->begin_iteration(scene.fields);
    const RowsAndRest parts = rows_and_rest(scene, *contact);
    const GlobalLayout layout(scene);
    std::set<Entry> coupled;
    contact->for_each_coupling([&](const Location& at) { insert(coupled, layout, at, at); },
                               [](Side /*first*/, const LoadPlace& /*load*/) {},
                               [&](Side first, const IndexedVector<TangentBlock>& rows) {
                                 for (const TangentBlock& row : rows)
                                   insert(coupled, layout, {first, row.rows}, {first, row.columns});
                               });
    BOOST_TEST((parts.rows > 0) == scene.effects.traction);
    BOOST_TEST(std::includes(coupled.begin(), coupled.end(), parts.by_rows.begin(), parts.by_rows.end()));
  }
}

BOOST_AUTO_TEST_CASE(couplings_hold_what_the_parts_fill) {
  for_each_state([](const Scene& scene, const ContactInterface& contact) {
    const Parts parts = parts_of(scene, contact);
    const Coupled found = coupled(scene, contact);
    BOOST_TEST(std::includes(found.entries.begin(), found.entries.end(), parts.entries.begin(), parts.entries.end()));
    const GlobalLayout layout(scene);
    contact.tangent(
        scene.fields, dt, [](const Location&, const Location&, const MatrixXd&) {},
        [&](Side first, const LoadBlock& load) {
          const std::set<Index>& places = found.loads.at(name_of(first, load.place));
          for (const Index column : layout.entries({first, load.place.columns})) BOOST_TEST(places.count(column) == 1U);
          for (const Index row : layout.entries({first, load.rows})) BOOST_TEST(places.count(row) == 1U);
        });
  });
}

BOOST_AUTO_TEST_CASE(nodes_of_facets_that_do_not_face_each_other_are_not_coupled) {
  for_each_state([](const Scene& scene, const ContactInterface& contact) {
    const std::set<Entry> apart = coupled(scene, contact).entries;
    const std::set<Entry> facing = of_facing_facets(scene, contact);
    BOOST_TEST(apart.empty() != scene.effects.traction);
    BOOST_TEST(std::includes(facing.begin(), facing.end(), apart.begin(), apart.end()));
    bool are_coupled_by_products = false;
    const GlobalLayout layout(scene);
    contact.for_each_coupling([&](const Location& at) {
      for (const Index row : layout.entries(at)) {
        for (const Index column : layout.entries(at))
          are_coupled_by_products = are_coupled_by_products || facing.count({row, column}) == 0U;
      }
    });
    BOOST_TEST(are_coupled_by_products);
  });
}

BOOST_AUTO_TEST_CASE(friction_symmetric_parts_and_unknown_multipliers_come_as_blocks) {
  Scene rubbing = overlapping(effects_of(true, 0), FacetType::quad4);
  rubbing.effects.friction_kind = FrictionKind::on_traction;
  rubbing.settings.friction.coefficient = 0.3;
  Scene symmetric = overlapping(effects_of(true, 0), FacetType::quad4);
  symmetric.settings.symmetric = true;
  Scene multipliers = overlapping(effects_of(true, 0), FacetType::quad4);
  multipliers.settings.enforcement = Enforcement::lagrange_multipliers;
  for (const Scene& scene : {rubbing, symmetric, multipliers}) {
    const auto contact = scene.contact();
    BOOST_TEST(!contact->pass(0).has_load_blocks());
    BOOST_TEST(parts_of(scene, *contact).loads == 0U);
    BOOST_TEST(coupled(scene, *contact).loads.empty());
  }
}
