#include "contact/integration/search.h"

#include "contact/integration/facing_share.h"
#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <algorithm>

using namespace test;

namespace {

constexpr double tolerance = 0.01;

/// A surface of 6 x 5 cells on a rectangle of 3 x 2, whose nodes are displaced by up to a seventh of a cell.
GridSurface random_surface(FacetType type, std::mt19937& random) {
  Grid grid{type, 6, 5, {-1, 0}, {2, 2}, 0, false};
  GridSurface surface = grid_surface(grid, 0);
  for (Index node = 0; node < surface.position.cols(); ++node) {
    surface.position.col(node) += random_vector(edge_degree(type) == 1 ? 0.07 : 0.03, random);
  }
  return surface;
}

Ray random_ray(std::mt19937& random) {
  const Vector3d origin = Vector3d(0.5, 1, 0) + random_vector(1, random).cwiseProduct(Vector3d(2, 1.5, 0.5));
  return {origin, (Vector3d(0, 0, 1) + random_vector(1, random)).normalized(), 0.8 + random_vector(0.7, random)[0],
          tolerance};
}

std::optional<RayHit> hit_of(const GridSurface& surface, std::size_t index, const Ray& ray) {
  const Facet& facet = surface.mesh.facets[index];
  return intersect(facet.type, facet_coordinates(facet, surface.position), ray.origin, ray.direction, ray.tolerance);
}

Eigen::Matrix<double, 3, 2> tangents_at(const GridSurface& surface, std::size_t index, const Vector2d& eta) {
  const Facet& facet = surface.mesh.facets[index];
  return facet_coordinates(facet, surface.position) * shape_functions(facet.type, eta).gradient;
}

bool faces(const GridSurface& surface, std::size_t index, const Vector2d& eta, const Vector3d& direction) {
  const auto tangents = tangents_at(surface, index, eta);
  const Facet& facet = surface.mesh.facets[index];
  return tangents.col(0).cross(tangents.col(1)).dot(direction) < 0 &&
         facing_share(direction, middle_normal(facet.type, facet_coordinates(facet, surface.position))) > 0;
}

/// The length by which hits are compared: the gap plus the distance outside the facet.
double length(const GridSurface& surface, std::size_t index, const RayHit& hit) {
  const double outside = distance_outside(surface.mesh.facets[index].type, hit.eta);
  return std::abs(hit.gap) + outside * tangents_at(surface, index, hit.eta).colwise().norm().maxCoeff();
}

/// The expected result of nearest_facing(), from a loop over all facets.
std::optional<SurfaceHit> brute_force(const GridSurface& surface, const Ray& ray) {
  std::optional<SurfaceHit> best;
  double shortest = 0;
  for (std::size_t f = 0; f < surface.mesh.facets.size(); ++f) {
    const std::optional<RayHit> hit = hit_of(surface, f, ray);
    if (!hit || std::abs(hit->gap) > ray.reach || !faces(surface, f, hit->eta, ray.direction)) continue;
    if (best && length(surface, f, *hit) >= shortest) continue;
    best = SurfaceHit{static_cast<int>(f), hit->eta, hit->gap};
    shortest = length(surface, f, *hit);
  }
  return best;
}

bool same(const std::optional<SurfaceHit>& one, const std::optional<SurfaceHit>& two) {
  if (!one || !two) return one.has_value() == two.has_value();
  return one->facet == two->facet && one->eta == two->eta && one->gap == two->gap;
}

std::optional<SurfaceHit> search(const GridSurface& surface, const Ray& ray) {
  const FacetTree tree(surface.mesh.facets, surface.position, box_margin);
  return nearest_facing(tree, surface.mesh.facets, surface.position, ray);
}

/// A single flat facet in z = 0 that faces downwards, for rays from below.
GridSurface plate() { return grid_surface({FacetType::quad4, 1, 1, {0, 0}, {1, 1}, 0, false}, 0); }

Ray upwards(double x, double y, double z, double reach = 10) { return {{x, y, z}, {0, 0, 1}, reach, tolerance}; }

}  // namespace

BOOST_AUTO_TEST_CASE(candidates_hold_every_facet_that_a_loop_over_all_finds) {
  std::mt19937 random(1);
  int hits = 0;
  for (const FacetType type : all_facets) {
    const GridSurface surface = random_surface(type, random);
    const FacetTree tree(surface.mesh.facets, surface.position, box_margin);
    for (int sample = 0; sample < 150; ++sample) {
      const Ray ray = random_ray(random);
      const std::vector<int> candidates = tree.candidates(ray.origin, ray.direction, ray.reach);
      BOOST_TEST(std::is_sorted(candidates.begin(), candidates.end()));
      for (std::size_t f = 0; f < surface.mesh.facets.size(); ++f) {
        const std::optional<RayHit> hit = hit_of(surface, f, ray);
        if (!hit || std::abs(hit->gap) > ray.reach) continue;
        ++hits;
        BOOST_TEST(std::binary_search(candidates.begin(), candidates.end(), static_cast<int>(f)));
      }
    }
  }
  BOOST_TEST(hits > 250);
}

BOOST_AUTO_TEST_CASE(candidates_leave_most_of_a_large_surface_out) {
  const GridSurface surface = grid_surface({FacetType::quad4, 30, 30, {0, 0}, {30, 30}, 0, false}, 0);
  const FacetTree tree(surface.mesh.facets, surface.position, box_margin);
  BOOST_TEST(tree.candidates({12.3, 17.6, 1}, {0, 0, 1}, 2).size() < 20U);
  BOOST_TEST(tree.candidates({12.3, 17.6, 5}, {0, 0, 1}, 2).size() < 20U);
}

BOOST_AUTO_TEST_CASE(the_nearest_facing_hit_is_that_of_a_loop_over_all_facets) {
  std::mt19937 random(2);
  int found = 0;
  for (const FacetType type : all_facets) {
    const GridSurface surface = random_surface(type, random);
    const FacetTree tree(surface.mesh.facets, surface.position, box_margin);
    for (int sample = 0; sample < 100; ++sample) {
      const Ray ray = random_ray(random);
      const std::optional<SurfaceHit> expected = brute_force(surface, ray);
      found += expected.has_value();
      BOOST_TEST(same(nearest_facing(tree, surface.mesh.facets, surface.position, ray), expected));
    }
  }
  BOOST_TEST(found > 150);
}

BOOST_AUTO_TEST_CASE(the_result_does_not_depend_on_earlier_searches) {
  std::mt19937 random(3);
  const GridSurface surface = random_surface(FacetType::quad8, random);
  const FacetTree tree(surface.mesh.facets, surface.position, box_margin);
  std::vector<Ray> rays;
  std::vector<std::optional<SurfaceHit>> fresh;
  for (int sample = 0; sample < 100; ++sample) {
    rays.push_back(random_ray(random));
    fresh.push_back(search(surface, rays.back()));
  }
  for (std::size_t i = rays.size(); i-- > 0;) {
    BOOST_TEST(same(nearest_facing(tree, surface.mesh.facets, surface.position, rays[i]), fresh[i]));
  }
}

BOOST_AUTO_TEST_CASE(back_faces_are_rejected) {
  const GridSurface surface = plate();
  Ray ray = upwards(0.4, 0.3, -1);
  BOOST_TEST(search(surface, ray).has_value());
  ray.direction *= -1;
  BOOST_TEST(!search(surface, ray).has_value());
}

BOOST_AUTO_TEST_CASE(a_thin_body_is_met_on_the_face_that_opposes_the_ray) {
  // Two layers are 0.1 apart. The ray starts near the upper one, which faces upwards, and finds the lower one, which
  // faces downwards.
  GridSurface surface = plate();
  const GridSurface top = grid_surface({FacetType::quad4, 1, 1, {0, 0}, {1, 1}, 0.1, true}, 0);
  Facet facet = top.mesh.facets[0];
  for (int a = 0; a < 4; ++a) facet.nodes[static_cast<std::size_t>(a)] += 4;
  surface.mesh.facets.insert(surface.mesh.facets.begin(), facet);
  surface.position.conservativeResize(3, 8);
  surface.position.rightCols(4) = top.position;
  const std::optional<SurfaceHit> hit = search(surface, upwards(0.5, 0.5, 0.09));
  BOOST_REQUIRE(hit.has_value());
  BOOST_TEST(hit->facet == 1);
  BOOST_TEST(std::abs(hit->gap + 0.09) <= rounding);
}

BOOST_AUTO_TEST_CASE(facets_are_seen_within_the_reach_on_either_side) {
  const GridSurface surface = plate();
  BOOST_TEST(search(surface, upwards(0.5, 0.5, -1, 1.5))->gap == 1.0);
  BOOST_TEST(search(surface, upwards(0.5, 0.5, 1, 1.5))->gap == -1.0);
  BOOST_TEST(!search(surface, upwards(0.5, 0.5, -1, 0.99)).has_value());
  BOOST_TEST(!search(surface, upwards(0.5, 0.5, 1, 0.99)).has_value());
  BOOST_TEST(!search(surface, upwards(1.5, 0.5, 0, 10)).has_value());
}

BOOST_AUTO_TEST_CASE(of_facets_at_the_same_distance_the_first_counts) {
  // The ray hits the corner that four facets share.
  const GridSurface surface = grid_surface({FacetType::quad4, 2, 2, {0, 0}, {1, 1}, 0, false}, 0);
  BOOST_TEST(search(surface, upwards(0.5, 0.5, -1))->facet == 0);
  GridSurface twice = plate();
  twice.mesh.facets.push_back(twice.mesh.facets[0]);
  BOOST_TEST(search(twice, upwards(0.3, 0.3, -1))->facet == 0);
}

BOOST_AUTO_TEST_CASE(the_gap_does_not_jump_where_facets_meet) {
  // A ridge and a valley at x = 0.5 have slopes of 40 degrees. Within the search tolerance at the edge, a ray hits the
  // extension of one facet nearer than the other facet. The gap may change by no more than the slope times the
  // distance.
  constexpr double way = 1e-4;
  const double slope = std::tan(40.0 / 180.0 * std::acos(-1.0));
  for (const double rise : {slope, -slope}) {
    GridSurface surface = grid_surface({FacetType::quad4, 2, 1, {0, 0}, {1, 1}, 0, false}, 0);
    surface.position.row(2) = rise * (surface.position.row(0).array() - 0.5).abs();
    double last = search(surface, upwards(0.48, 0.4, -1))->gap;
    for (double x = 0.48 + way; x < 0.52; x += way) {
      const double gap = search(surface, upwards(x, 0.4, -1))->gap;
      BOOST_TEST(std::abs(gap - last) <= (1 + tolerance) * slope * way);
      last = gap;
    }
  }
}

BOOST_AUTO_TEST_CASE(a_surface_without_facets_is_never_met) {
  GridSurface surface = plate();
  surface.mesh.facets.clear();
  BOOST_TEST(!search(surface, upwards(0.5, 0.5, -1)).has_value());
}

BOOST_AUTO_TEST_CASE(a_surface_that_moves_is_searched_as_if_anew) {
  // Small motions keep the neighbours; a few are larger than the slack (a quarter of a facet).
  std::mt19937 random(4);
  int found = 0;
  int kept = 0;
  for (const FacetType type : all_facets) {
    GridSurface surface = random_surface(type, random);
    MovingSurface moving;
    std::vector<Ray> rays;
    for (int i = 0; i < 20; ++i) rays.push_back(random_ray(random));
    std::vector<RayNeighbours> neighbours(rays.size());
    for (int step = 0; step < 12; ++step) {
      const double way = step % 5 == 4 ? 0.3 : 0.01;
      const Vector3d shift = random_vector(way, random);
      for (Index node = 0; node < surface.position.cols(); ++node) {
        surface.position.col(node) += shift + random_vector(0.002, random);
      }
      moving.move_to(surface.mesh.facets, surface.position);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        rays[i].origin += random_vector(way, random);
        rays[i].direction = (rays[i].direction + random_vector(0.1 * way, random)).normalized();
        const RayNeighbours before = neighbours[i];
        const std::optional<SurfaceHit> hit = moving.nearest_facing(surface.mesh.facets, rays[i], neighbours[i]);
        BOOST_TEST(same(hit, search(surface, rays[i])));
        found += hit.has_value();
        kept += neighbours[i].reference == before.reference && neighbours[i].ends == before.ends;
      }
    }
  }
  BOOST_TEST(found > 200);
  BOOST_TEST(kept > 500);
}

BOOST_AUTO_TEST_CASE(surfaces_out_of_reach_are_told_by_their_boxes) {
  const GridSurface one = plate();
  Matrix3Xd two = one.position;
  two.row(2).array() += 2;
  // Boxes are enlarged by a tenth of their diagonal, sqrt(2), on both sides.
  const double apart = 2 - 2 * 0.1 * std::sqrt(2.0);
  BOOST_TEST(!surfaces_within_reach(one.position, two, apart - 1e-9));
  BOOST_TEST(surfaces_within_reach(one.position, two, apart + 1e-9));
}
