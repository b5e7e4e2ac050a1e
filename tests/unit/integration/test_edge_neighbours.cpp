#include "contact/integration/edge_neighbours.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

using namespace test;

namespace {

/// Numbers of edges of a surface's facets with and without a neighbour.
struct Edges {
  int joint = 0;
  int free = 0;
};

Edges edges_of(const SurfaceMesh& mesh) {
  const EdgeNeighbours neighbours(mesh);
  Edges edges;
  for (int facet = 0; facet < mesh.facets.count(); ++facet) {
    for (int corner = 0; corner < corner_count(mesh.facets[facet].type); ++corner)
      ++(neighbours.across(facet, corner) ? edges.joint : edges.free);
  }
  return edges;
}

SurfaceMesh grid_of(FacetType type) { return grid_surface({type, 3, 2}, 1).mesh; }

}  // namespace

BOOST_AUTO_TEST_CASE(neighbours_share_both_ends_of_an_edge) {
  for (const FacetType type : all_facets) {
    const SurfaceMesh mesh = grid_of(type);
    const EdgeNeighbours neighbours(mesh);
    for (int facet = 0; facet < mesh.facets.count(); ++facet) {
      const Facet& one = mesh.facets[facet];
      for (int corner = 0; corner < corner_count(one.type); ++corner) {
        const std::optional<int> other = neighbours.across(facet, corner);
        if (!other) continue;
        BOOST_TEST(*other != facet);
        const Facet& two = mesh.facets[*other];
        for (const int node : {one.node(corner), one.node((corner + 1) % corner_count(one.type))})
          BOOST_TEST(std::count(two.begin(), two.begin() + corner_count(two.type), node) == 1);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_surface_ends_at_its_rim_alone) {
  // The grid of 3 x 2 cells has ten edges on its boundary, seven between cells, and six diagonals if cells consist of
  // triangles.
  for (const FacetType type : all_facets) {
    const Edges edges = edges_of(grid_of(type));
    BOOST_TEST(edges.free == 10);
    BOOST_TEST(edges.joint == 2 * (is_triangle(type) ? 13 : 7));
  }
}

BOOST_AUTO_TEST_CASE(facets_that_let_other_fields_through_are_no_neighbours) {
  SurfaceMesh mesh = grid_of(FacetType::quad4);
  mesh.permeable.front() = 0;
  BOOST_TEST(edges_of(mesh).joint == 14 - 2 * 2);  // it is at a corner of the grid
}

BOOST_AUTO_TEST_CASE(an_edge_of_three_facets_has_no_neighbours) {
  SurfaceMesh mesh = grid_of(FacetType::quad4);
  mesh.facets.push_back(mesh.facets.front());
  mesh.permeable.push_back(mesh.permeable.front());
  BOOST_TEST(edges_of(mesh).joint == 14 - 2 * 2);
}

BOOST_AUTO_TEST_CASE(of_a_surface_that_is_not_known_no_facet_has_neighbours) {
  BOOST_TEST(!EdgeNeighbours().across(3, 1).has_value());
}
