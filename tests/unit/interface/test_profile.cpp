/// Tests of the entries that a contact adds to a matrix: exactly those of the exchanged effects.
#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <set>

using namespace test;

namespace {

constexpr int cells = 4;
constexpr int known_columns = 2;  ///< number of columns of cells in which a partly known field is known

using Entry = std::pair<Index, Index>;

/// Grids that match node by node, in full contact. Only the first `known_columns` columns of cells of the secondary
/// surface know the fields of `partly`.
Scene matching(const Effects& effects, FieldMask partly = 0) {
  Scene scene(facing_grids(FacetType::quad4, FacetType::quad4, 0.05, cells, cells), effects,
              explicit_settings(3, 2, 5));
  std::mt19937 random(1);
  scene.disturb(0.005, random);
  SurfaceMesh& secondary = scene.mesh[Side::secondary];
  for (std::size_t f = 0; f < secondary.facets.size(); ++f) {
    const Matrix3Xd& x = scene.fields[Side::secondary].position;
    const double middle = facet_coordinates(secondary.facets[f], x).row(0).mean();
    if (middle > known_columns / (1.0 * cells)) secondary.permeable[f] &= ~partly;
  }
  return scene;
}

/// Positions of a surface's nodes on the grid.
std::vector<std::array<int, 2>> places(const Scene& scene, Side side) {
  const Matrix3Xd& x = scene.fields[side].position;
  std::vector<std::array<int, 2>> result;
  for (Index n = 0; n < x.cols(); ++n) {
    result.push_back({static_cast<int>(std::lround(cells * x(0, n))), static_cast<int>(std::lround(cells * x(1, n)))});
  }
  return result;
}

/// Calls use(side, node, side, node) for every two nodes on the facets around a point of the grid.
template <class Use>
void for_neighbours(const PerSide<std::vector<std::array<int, 2>>>& place, const std::array<int, 2>& centre,
                    const Use& use) {
  std::vector<std::pair<Side, Index>> near;
  for (const Side side : both_sides) {
    for (std::size_t n = 0; n < place[side].size(); ++n) {
      const auto [i, j] = place[side][n];
      if (std::abs(i - centre[0]) <= 1 && std::abs(j - centre[1]) <= 1) near.emplace_back(side, static_cast<Index>(n));
    }
  }
  for (const auto& [side, node] : near) {
    for (const auto& [other_side, other_node] : near) use(side, node, other_side, other_node);
  }
}

/// The entries that the effects require, from the grid alone. The load at a node acts on, and depends on, the nodes of
/// all facets around it. A traction acts on displacements and depends on displacements; a flux acts on its field and
/// depends on displacements and the field. `profile`: whether the entries are made symmetric, as in a profile.
std::set<Entry> expected(const Scene& scene, FieldMask partly, bool profile) {
  const GlobalLayout layout(scene);
  const PerSide<std::vector<std::array<int, 2>>> place{{places(scene, Side::primary), places(scene, Side::secondary)}};
  std::set<Entry> entries;
  for (const auto& centre : place[Side::primary]) {
    for_neighbours(place, centre, [&](Side one, Index a, Side two, Index b) {
      for (Index i = 0; i < 3; ++i) {
        for (Index j = 0; j < 3; ++j) entries.emplace(layout.entry(one, a, i), layout.entry(two, b, j));
      }
      for (int k = 0; k < scene.effects.scalar_fields(); ++k) {
        if (contains(partly, k) && centre[0] > known_columns) continue;
        const Index row = layout.entry(one, a, 3 + k);
        entries.emplace(row, layout.entry(two, b, 3 + k));
        for (Index j = 0; j < 3; ++j) {
          entries.emplace(row, layout.entry(two, b, j));
          if (profile) entries.emplace(layout.entry(two, b, j), row);
        }
      }
    });
  }
  return entries;
}

void add(std::set<Entry>& entries, const std::vector<Index>& rows, const std::vector<Index>& columns) {
  for (const Index row : rows) {
    for (const Index column : columns) entries.emplace(row, column);
  }
}

/// The entries that the contact of a scene adds to a profile, including those that its tangent fills.
std::set<Entry> in_profile(const Scene& scene) {
  const GlobalLayout layout(scene);
  const auto contact = scene.contact();
  std::set<Entry> entries;
  contact->for_each_coupling(
      [&](const ContactInterface::Location& at) { add(entries, layout.entries(at), layout.entries(at)); });
  return entries;
}

std::set<Entry> in_tangent(const Scene& scene) {
  const GlobalLayout layout(scene);
  const auto contact = scene.contact();
  std::set<Entry> entries;
  contact->tangent(scene.fields, 1, [&](const auto& rows, const auto& columns, const MatrixXd&) {
    add(entries, layout.entries(rows), layout.entries(columns));
  });
  return entries;
}

void check(const Scene& scene, FieldMask partly = 0) {
  BOOST_TEST((in_profile(scene) == expected(scene, partly, true)));
  BOOST_TEST((in_tangent(scene) == expected(scene, partly, false)));
}

/// The entries in rows and columns below `size`.
std::set<Entry> below(Index size, const std::set<Entry>& entries) {
  std::set<Entry> found;
  for (const Entry& entry : entries) {
    if (entry.first < size && entry.second < size) found.insert(entry);
  }
  return found;
}

/// The entries between the nodes of facing facets.
std::set<Entry> of_facing_facets(const Scene& scene) {
  const GlobalLayout layout(scene);
  const auto contact = scene.contact();
  const MortarSpace& space = contact->pass(0).space();
  std::set<Entry> entries;
  for (const FacetPair& pair : space.facing().pairs()) {
    const Patch patch = patch_of(space.facing(), pair);
    const auto add_patch = [&](const Patch& part) {
      const std::vector<Index> all = layout.entries({Side::primary, part});
      add(entries, all, all);
    };
    add_patch(patch.of_displacements());
    for (const int field : patch.fields) add_patch(space.columns_of(patch, field));
  }
  return entries;
}

/// The entries of the tangent that are not zero, made symmetric as in a profile.
std::set<Entry> other_than_zero(const Scene& scene) {
  const GlobalLayout layout(scene);
  const auto contact = scene.contact();
  std::set<Entry> entries;
  contact->tangent(scene.fields, 1, [&](const auto& rows, const auto& columns, const MatrixXd& values) {
    const std::vector<Index> row = layout.entries(rows);
    const std::vector<Index> column = layout.entries(columns);
    for (Index i = 0; i < values.rows(); ++i) {
      for (Index j = 0; j < values.cols(); ++j) {
        if (values(i, j) == 0) continue;
        entries.emplace(at(row, i), at(column, j));
        entries.emplace(at(column, j), at(row, i));
      }
    }
  });
  return entries;
}

/// Number of pairs of nodes at most two apart on a line of `cells` elements.
constexpr std::size_t near_pairs_on_a_line = 5 * cells - 1;

}  // namespace

BOOST_AUTO_TEST_CASE(entries_are_those_of_the_effects) {
  for (const auto& [solvent, solutes] : {std::pair{false, 0}, {true, 0}, {true, 1}, {true, 2}, {true, 4}, {false, 1}}) {
    const Scene scene = matching(effects_of(solvent, solutes));
    check(scene);
    // Two nodes share a facet's node if they are at most two apart along x and along y.
    const auto fields = static_cast<std::size_t>(scene.effects.scalar_fields());
    const std::size_t pairs = 4 * near_pairs_on_a_line * near_pairs_on_a_line;
    BOOST_TEST(in_profile(scene).size() == pairs * (9 + 7 * fields));
  }
}

BOOST_AUTO_TEST_CASE(a_field_has_entries_only_where_both_surfaces_know_it) {
  const Effects effects = effects_of(true, 2);
  for (const FieldMask partly : {only(0), only(2), only(1) | only(2)}) check(matching(effects, partly), partly);
}

BOOST_AUTO_TEST_CASE(an_impermeable_surface_adds_displacements_alone) {
  Scene impermeable = matching(effects_of(true, 1));
  for (FieldMask& mask : impermeable.mesh[Side::secondary].permeable) mask = 0;
  const std::size_t pairs = 4 * near_pairs_on_a_line * near_pairs_on_a_line;
  BOOST_TEST(in_profile(impermeable).size() == pairs * 9);
  BOOST_TEST(in_tangent(impermeable).size() == pairs * 9);
}

BOOST_AUTO_TEST_CASE(apart_there_are_no_entries) {
  Scene apart = matching(effects_of(true, 1));
  apart.fields[Side::secondary].position.row(2).array() += 0.2;
  BOOST_TEST(in_profile(apart).empty());
  BOOST_TEST(in_tangent(apart).empty());
}

BOOST_AUTO_TEST_CASE(unknown_multipliers_couple_only_nodes_of_facets_that_face_each_other) {
  for (const Effects& effects : {effects_of(false, 0), effects_of(true, 1)}) {
    Scene scene = matching(effects);
    const std::set<Entry> with_penalties = in_profile(scene);
    scene.settings.enforcement = Enforcement::lagrange_multipliers;
    const GlobalLayout layout(scene);
    const std::set<Entry> profile = below(layout.size(), in_profile(scene));
    const std::set<Entry> between_nodes = below(layout.nodal_size(), profile);
    BOOST_TEST((between_nodes == of_facing_facets(scene)));
    BOOST_TEST(between_nodes.size() < with_penalties.size());
    const std::set<Entry> tangent = below(layout.size(), in_tangent(scene));
    BOOST_TEST(std::includes(profile.begin(), profile.end(), tangent.begin(), tangent.end()));
    for (Index multiplier = layout.nodal_size(); multiplier < layout.size(); ++multiplier)
      BOOST_TEST(tangent.count({multiplier, multiplier}) == 1U);
  }
}

BOOST_AUTO_TEST_CASE(nodes_of_quadratic_facets_have_entries_only_with_what_their_averages_are_taken_over) {
  for (const FacetType type : {FacetType::tri6, FacetType::tri7, FacetType::quad8, FacetType::quad9}) {
    Scene scene(facing_grids(type, FacetType::quad4, 0.05, 2, 5), effects_of(false, 0), explicit_settings(3, 2, 5));
    scene.settings.integration = Integration::segments;
    std::mt19937 random(1);
    scene.disturb(0.005, random);
    const std::set<Entry> profile = in_profile(scene);
    BOOST_TEST(!profile.empty());
    BOOST_TEST((profile == other_than_zero(scene)));
  }
}

BOOST_AUTO_TEST_CASE(the_profile_has_the_places_of_quadratic_facets_that_are_partly_in_contact) {
  for (const FacetType type : {FacetType::tri6, FacetType::tri7, FacetType::quad8, FacetType::quad9}) {
    Scene scene(facing_grids(type, type, 0.05, 3, 5), effects_of(true, 1), explicit_settings(3, 2, 5));
    scene.settings.integration = Integration::segments;
    Matrix3Xd& x = scene.fields[Side::secondary].position;
    x.row(2) += 0.1 * x.row(0);
    const std::set<Entry> profile = in_profile(scene);
    const std::set<Entry> tangent = in_tangent(scene);
    BOOST_TEST(std::includes(profile.begin(), profile.end(), tangent.begin(), tangent.end()));
  }
}
