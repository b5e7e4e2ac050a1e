#include "contact/integration/segments.h"

#include "contact/integration/facing_share.h"
#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <numeric>

using namespace test;

namespace {

/// Rounding error of sums over hundreds of points, each the result of a few dozen operations.
constexpr double exact = 1e-12;

constexpr std::array<std::pair<int, int>, 3> divisions{{{1, 1}, {2, 3}, {4, 3}}};

/// Triangles and quadrilaterals with one and with several linear pieces.
constexpr std::array differently_cut{FacetType::tri3, FacetType::tri6, FacetType::quad4, FacetType::quad8};

/// Facing unit squares with different numbers of cells.
Scene squares(FacetType one, FacetType two, int cells_one, int cells_two, double overlap = 0.0625) {
  Settings settings = explicit_settings(4, 2, 8);
  settings.integration = Integration::segments;
  return {facing_grids(one, two, overlap, cells_one, cells_two), effects_of(true, 1), settings};
}

FacingFacets facets_of(const Scene& scene) {
  return {scene.mesh[Side::primary].facets, scene.mesh[Side::secondary].facets};
}

FacingPositions positions_of(const Scene& scene) { return positions(seen_from(Side::primary, scene.fields)); }

FacetPairs pairs_of(const Scene& scene, int order = 0) {
  return Segments(order).search(facets_of(scene), positions_of(scene), 1);
}

/// Calls `use` with the kinematics at the points of all pairs.
void for_each_point(
    const Scene& scene, const FacetPairs& found,
    const std::function<void(const Facet&, const Facet&, const IntegrationPoint&, const PointKinematics&)>& use) {
  for (const FacetPair& pair : found.pairs()) {
    const Facet& one = scene.mesh[Side::primary].facets[static_cast<std::size_t>(pair.primary)];
    const Facet& two = scene.mesh[Side::secondary].facets[static_cast<std::size_t>(pair.secondary)];
    for (const IntegrationPoint& point : found.points(pair)) {
      use(one, two, point,
          point_kinematics(
              shape_functions(one.type, point.xi), facet_coordinates(one, scene.fields[Side::primary].position),
              shape_functions(two.type, point.eta), facet_coordinates(two, scene.fields[Side::secondary].position)));
    }
  }
}

/// INT psi_a f(x) da per node over a whole surface, by Gauss rules of high order on the linear pieces.
VectorXd nodal_integrals(const SurfaceMesh& mesh, const Matrix3Xd& position, bool ordinary_shape,
                         const std::function<double(const Vector3d&)>& f) {
  VectorXd sum = VectorXd::Zero(mesh.nodes);
  for (const Facet& facet : mesh.facets) {
    const FacetCoordinates x = facet_coordinates(facet, position);
    for (const QuadraturePoint& q : piecewise_quadrature(facet.type, 6)) {
      const ShapeFunctions shape = shape_functions(facet.type, q.xi);
      const Eigen::Matrix<double, 3, 2> tangents = x * shape.gradient;
      const double area = q.weight * tangents.col(0).cross(tangents.col(1)).norm();
      const FacetVector psi = ordinary_shape
                                  ? shape.value
                                  : multiplier_functions(facet.type, sub_facet_at(facet.type, q.xi), q.xi).value;
      for (Index a = 0; a < psi.size(); ++a) {
        sum[facet.nodes[static_cast<std::size_t>(a)]] += area * psi[a] * f(x * shape.value);
      }
    }
  }
  return sum;
}

/// A facet opposite four or eight rotated ones. Edges cross at an angle, because the third derivatives of a crossing
/// grow with the cube of its cotangent.
Scene turned_squares(FacetType one, FacetType two, std::mt19937& random) {
  Scene scene = squares(one, two, 1, 2, 0.08);
  turn(scene.fields[Side::secondary].position, 0.5);
  scene.disturb(0.02, random);
  return scene;
}

using Function = std::function<VectorXd(const VectorXd&)>;

MatrixXd plain_differences(const Function& function, const VectorXd& x) { return differences(function, x); }

/// A surface of 2 x 2 cells and one of 3 x 3 that is rotated and scaled by a factor.
Scene turned_beneath(FacetType one, FacetType two, double size, std::mt19937& random) {
  Scene scene = squares(one, two, 2, 3, 0.08);
  Matrix3Xd& x2 = scene.fields[Side::secondary].position;
  turn(x2, 0.5);
  x2.topRows<2>() = (size * (x2.topRows<2>().array() - 0.5) + 0.5).matrix();
  scene.disturb(0.01, random);
  return scene;
}

/// The pairs of a scene, with the edge neighbours of the secondary surface.
FacetPairs pairs_with_neighbours(const Scene& scene, int order = 0) {
  const SurfaceMesh& two = scene.mesh[Side::secondary];
  return Segments(order, {}, EdgeNeighbours(two)).search(facets_of(scene), positions_of(scene), 1);
}

/// Relative error of a contact's tangent at constant contact status.
double tangent_error(const Scene& scene, MatrixXd (*difference)(const Function&, const VectorXd&) = plain_differences) {
  const auto contact = scene.contact();
  accept_any_load(*contact);
  contact->begin_iteration(scene.fields);
  const GlobalLayout layout(scene);
  const VectorXd q = layout.pack(scene.fields);
  const MatrixXd approximate = difference(
      [&](const VectorXd& at) -> VectorXd {
        const PerSide<SurfaceFields> fields = layout.unpack(at);
        contact->project({{fields[Side::primary].position, fields[Side::secondary].position}});
        return assembled_residual(*contact, layout, fields, 0.3);
      },
      q);
  contact->project(scene.position());
  const MatrixXd tangent = assembled_tangent(*contact, layout, scene.fields, 0.3);
  return (tangent - approximate).norm() / tangent.norm();
}

/// A primary facet and a facing one, without others.
struct LonePair {
  IndexedVector<Facet> primary;
  IndexedVector<Facet> secondary;
  VectorXd nodes;  ///< coordinates of the primary nodes, then of the secondary nodes

  LonePair(const Scene& scene, Facet one, Facet two) {
    nodes.resize(3 * (node_count(one.type) + node_count(two.type)));
    nodes << facet_coordinates(one, scene.fields[Side::primary].position).reshaped(),
        facet_coordinates(two, scene.fields[Side::secondary].position).reshaped();
    for (Facet* facet : {&one, &two}) std::iota(facet->nodes.begin(), facet->nodes.end(), 0);
    primary = {one};
    secondary = {two};
  }
  Index primary_size() const { return 3 * node_count(primary.front().type); }
  Matrix3Xd x1(const VectorXd& at) const { return at.head(primary_size()).reshaped(3, primary_size() / 3); }
  Matrix3Xd x2(const VectorXd& at) const {
    const Index size = at.size() - primary_size();
    return at.tail(size).reshaped(3, size / 3);
  }
};

/// The weights of a pair's points, and their coordinates times the weights, which are the terms of integrals.
VectorXd weighted(const PointsOfPair& points) {
  VectorXd result(3 * points.count());
  Index row = 0;
  for (const IntegrationPoint& point : points) {
    result.segment<3>(row) = point.weight * Vector3d(1, point.xi[0], point.xi[1]);
    row += 3;
  }
  return result;
}

/// The variation of weighted() with respect to the motions of the points.
MatrixXd weighted_motion(const PointsOfPair& points, const IndexedVector<PointMotion>& motions) {
  MatrixXd result(3 * motions.count(), motions.front().weight.cols());
  for (Index i = 0; i < motions.count(); ++i) {
    result.middleRows<3>(3 * i) << motions[i].weight, motions[i].xi + points[i].xi * motions[i].weight;
    result.middleRows<3>(3 * i) *= points[i].weight;
  }
  return result;
}

/// Squares of the error and of the size of the motions of a pair's points, by central differences. Some overlaps are
/// slivers of width 1e-3, over which the motions vary.
Vector2d motion_error(const LonePair& lone) {
  const FacingFacets facets{lone.primary, lone.secondary};
  Segments segments(0);
  const FacetPairs found = segments.search(facets, {lone.x1(lone.nodes), lone.x2(lone.nodes)}, 1);
  if (found.pairs().empty()) return {0, 0};
  const FacetPair& pair = found.pairs().front();
  const MatrixXd approximate = fine_differences(
      [&](const VectorXd& at) {
        const FacetPairs moved = segments.on_same_facets(facets, {lone.x1(at), lone.x2(at)});
        return weighted(moved.points(moved.pairs().front()));
      },
      lone.nodes);
  IndexedVector<PointMotion> motions;
  segments.for_each_motion(pair, found.points(pair), facets, {lone.x1(lone.nodes), lone.x2(lone.nodes)},
                           [&](const PointMotion& motion) { motions.push_back(motion); });
  const MatrixXd motion = weighted_motion(found.points(pair), motions);
  return {(motion - approximate).squaredNorm(), approximate.squaredNorm()};
}

}  // namespace

BOOST_AUTO_TEST_CASE(pieces_cover_facing_squares_exactly_whatever_their_divisions) {
  for (const auto& [one, two] : facet_pairs()) {
    for (const auto& [cells_one, cells_two] : divisions) {
      const Scene scene = squares(one, two, cells_one, cells_two);
      double area = 0;
      for_each_point(scene, pairs_of(scene),
                     [&](const Facet&, const Facet&, const IntegrationPoint& place, const PointKinematics& point) {
                       area += place.weight * point.area;
                       BOOST_TEST(std::abs(point.gap + 0.0625) <= exact);
                     });
      BOOST_TEST(std::abs(area - 1) <= exact);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_facet_that_is_faced_has_as_many_pieces_as_its_corners_make) {
  const auto points = [](FacetType one, FacetType two) { return pairs_of(squares(one, two, 3, 2), 2).points().size(); };
  for (const FacetType one : all_facets) {
    BOOST_TEST(points(one, FacetType::tri6) == points(one, FacetType::tri3));
    BOOST_TEST(points(one, FacetType::quad8) == points(one, FacetType::quad4));
  }
}

BOOST_AUTO_TEST_CASE(outlines_that_bend_inwards_cover_a_square_exactly) {
  std::mt19937 random(13);
  for (const FacetType one : all_facets) {
    for (const FacetType two : {FacetType::tri6, FacetType::quad8}) {
      Scene scene = squares(one, two, 3, 2);
      Matrix3Xd& x2 = scene.fields[Side::secondary].position;
      const Matrix3Xd straight = x2;
      scene.disturb(0.03, random);
      scene.fields[Side::primary].position = squares(one, two, 3, 2).fields[Side::primary].position;
      x2.row(2) = straight.row(2);
      for (Index node = 0; node < x2.cols(); ++node) {
        const auto place = straight.col(node).head<2>().array();
        if (((place == 0) || (place == 1)).any()) x2.col(node) = straight.col(node);
      }
      double area = 0;
      for_each_point(scene, pairs_of(scene, 2),
                     [&](const Facet&, const Facet&, const IntegrationPoint& place, const PointKinematics& point) {
                       area += place.weight * point.area;
                     });
      BOOST_TEST(std::abs(area - 1) <= exact);
    }
  }
}

BOOST_AUTO_TEST_CASE(weighted_integrals_of_an_affine_gap_are_exact) {
  const auto gap = [](const Vector3d& x) { return 0.3 * x[0] - 0.2 * x[1] - 0.1; };
  for (const auto& [one, two] : facet_pairs()) {
    for (const auto& [cells_one, cells_two] : divisions) {
      Scene scene = squares(one, two, cells_one, cells_two);
      Matrix3Xd& x2 = scene.fields[Side::secondary].position;
      for (Index node = 0; node < x2.cols(); ++node) x2(2, node) = gap(x2.col(node));
      VectorXd sum = VectorXd::Zero(scene.mesh[Side::primary].nodes);
      for_each_point(
          scene, pairs_of(scene, 4),
          [&](const Facet& facet, const Facet&, const IntegrationPoint& place, const PointKinematics& point) {
            const FacetVector psi = multiplier_functions(facet.type, place.sub_facet, place.xi).value;
            for (Index a = 0; a < psi.size(); ++a) {
              sum[facet.nodes[static_cast<std::size_t>(a)]] += place.weight * point.area * psi[a] * point.gap;
            }
          });
      const VectorXd expected = nodal_integrals(scene.mesh[Side::primary], scene.fields[Side::primary].position, false,
                                                gap);
      BOOST_TEST((sum - expected).norm() <= exact);
    }
  }
}

BOOST_AUTO_TEST_CASE(integrals_do_not_jump_where_corners_pass_edges) {
  // A corner of four rotated facets passes the middle of each edge of a square. The rule of order 2 has an error for
  // x^4, which must not jump there. A shift moves the edges of the overlaps, whose total length is at most 8, by the
  // same distance, and x^4 is at most 1.
  constexpr double shift = 1e-7;
  const auto integral = [](const Vector2d& corner) {
    Scene scene = squares(FacetType::quad4, FacetType::quad4, 1, 2);
    turn(scene.fields[Side::secondary].position, 0.5);
    scene.fields[Side::secondary].position.topRows<2>().colwise() += corner - Vector2d(0.5, 0.5);
    double sum = 0;
    for_each_point(scene, pairs_of(scene),
                   [&](const Facet& facet, const Facet&, const IntegrationPoint& place, const PointKinematics& point) {
                     const Vector3d x = facet_coordinates(facet, scene.fields[Side::primary].position) *
                                        point.primary_shape;
                     sum += place.weight * point.area * std::pow(x[0], 4);
                   });
    return sum;
  };
  for (const Vector2d& inwards : {Vector2d(1, 0), Vector2d(-1, 0), Vector2d(0, 1), Vector2d(0, -1)}) {
    const Vector2d edge = 0.5 * (Vector2d::Ones() - inwards);
    const double inside = integral(edge + shift * inwards);
    BOOST_TEST(std::abs(inside - integral(edge - shift * inwards)) <= 2 * 8 * shift);
    BOOST_TEST(std::abs(inside - integral(edge)) <= 8 * shift);
  }
}

/// Integrals of the secondary shape functions over all integration points.
VectorXd secondary_integrals(const Scene& scene) {
  VectorXd sum = VectorXd::Zero(scene.mesh[Side::secondary].nodes);
  for_each_point(scene, pairs_of(scene),
                 [&](const Facet&, const Facet& facet, const IntegrationPoint& place, const PointKinematics& point) {
                   for (Index b = 0; b < point.secondary_shape.size(); ++b) {
                     sum[facet.node(b)] += place.weight * point.area * point.secondary_shape[b];
                   }
                 });
  return sum;
}

BOOST_AUTO_TEST_CASE(a_uniform_load_reaches_the_nodes_of_the_other_side_exactly) {
  for (const auto& [one, two] : facet_pairs()) {
    for (const auto& [cells_one, cells_two] : divisions) {
      const Scene scene = squares(one, two, cells_one, cells_two);
      const VectorXd sum = secondary_integrals(scene);
      const VectorXd expected = nodal_integrals(scene.mesh[Side::secondary], scene.fields[Side::secondary].position,
                                                true, [](const Vector3d&) { return 1.0; });
      BOOST_TEST((sum - expected).norm() <= exact);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_smaller_square_turned_in_the_plane_is_covered_exactly) {
  for (const auto& [one, two] : facet_pairs()) {
    Scene scene = squares(one, two, 3, 2);
    Matrix3Xd& x2 = scene.fields[Side::secondary].position;
    x2.topRows<2>() = (0.6 * x2.topRows<2>().array() + 0.2).matrix();
    turn(x2, 0.5);
    const VectorXd sum = secondary_integrals(scene);
    BOOST_TEST(std::abs(sum.sum() - 0.36) <= exact);  // shape functions add up to one
    const VectorXd expected = nodal_integrals(scene.mesh[Side::secondary], x2, true,
                                              [](const Vector3d&) { return 1.0; });
    BOOST_TEST((sum - expected).norm() <= exact);
  }
}

BOOST_AUTO_TEST_CASE(a_surface_covered_in_part_carries_the_exact_force_and_flows) {
  for (const auto& [one, two] : facet_pairs()) {
    Scene scene = squares(one, two, 3, 2);
    Matrix3Xd& x2 = scene.fields[Side::secondary].position;
    x2.topRows<2>() = (0.6 * x2.topRows<2>().array() + 0.2).matrix();
    turn(x2, 0.5);
    scene.set_field(0, 0.5, 0.25);
    const Balance total = output(*scene.contact(), scene.fields).balance;
    BOOST_TEST(std::abs(total.area - 0.36) <= exact);
    BOOST_TEST((total.force - Vector3d(0, 0, -4 * 0.0625 * 0.36)).norm() <= exact);
    BOOST_TEST(std::abs(total.flow[0] - 2 * 0.25 * 0.36) <= exact);
    const GlobalLayout layout(scene);
    const VectorXd residual = assembled_residual(*scene.contact(), layout, scene.fields, 1);
    // The nodal loads on the covering surface are those of a uniform traction and flux.
    const VectorXd shares = nodal_integrals(scene.mesh[Side::secondary], x2, true, [](const Vector3d&) { return 1.0; });
    for (Index node = 0; node < shares.size(); ++node) {
      BOOST_TEST(std::abs(residual[layout.entry(Side::secondary, node, 2)] - 4 * 0.0625 * shares[node]) <= exact);
      BOOST_TEST(std::abs(residual[layout.entry(Side::secondary, node, 3)] + 2 * 0.25 * shares[node]) <= exact);
    }
    for (Index component = 0; component < layout.per_node(); ++component) {
      double sum = 0;
      for (Index i = component; i < layout.size(); i += layout.per_node()) sum += residual[i];
      BOOST_TEST(std::abs(sum) <= exact);
    }
  }
}

BOOST_AUTO_TEST_CASE(facets_that_face_away_or_lie_behind_others_are_left_out) {
  Scene scene = squares(FacetType::quad4, FacetType::quad4, 2, 3);
  SurfaceMesh& mesh = scene.mesh[Side::secondary];
  Matrix3Xd& x2 = scene.fields[Side::secondary].position;
  // The surface gets a second, farther layer of the same facets, and a third one in between that faces away.
  const std::vector<Facet> first = mesh.facets;
  const Matrix3Xd near = x2;
  x2.resize(3, 3 * near.cols());
  x2 << near, near.colwise() - Vector3d(0, 0, 0.5), near.colwise() - Vector3d(0, 0, 0.2);
  for (const bool away : {false, true}) {
    for (Facet facet : first) {
      for (int& node : facet.nodes) node += (away ? 2 : 1) * mesh.nodes;
      if (away) std::swap(facet.nodes[1], facet.nodes[3]);
      mesh.facets.push_back(facet);
    }
  }
  const FacetPairs found = pairs_of(scene);
  for (const FacetPair& pair : found.pairs()) BOOST_TEST(pair.secondary < static_cast<int>(first.size()));
  BOOST_TEST(found.pairs().size() == 16U);
}

BOOST_AUTO_TEST_CASE(facets_out_of_reach_are_not_seen) {
  const Scene scene = squares(FacetType::quad4, FacetType::quad4, 2, 3, -1.5);
  BOOST_TEST(pairs_of(scene).pairs().empty());
}

BOOST_AUTO_TEST_CASE(the_motion_of_a_step_extends_the_reach_of_overlaps_alone) {
  Reach reach = 1;
  reach.beyond = 1;
  for (const double overlap : {-1.5, 1.5}) {
    const Scene scene = squares(FacetType::quad4, FacetType::quad4, 2, 3, overlap);
    Segments segments(0);
    const auto sees = [&](const Reach& within) {
      return !segments.search(facets_of(scene), positions_of(scene), within).pairs().empty();
    };
    BOOST_TEST(!sees(1));
    BOOST_TEST(sees(reach) == (overlap > 0));
  }
}

BOOST_AUTO_TEST_CASE(facets_that_lose_each_other_twice_in_a_step_see_each_other_until_its_iterations_end) {
  const Scene scene = squares(FacetType::quad4, FacetType::quad4, 1, 1, 0.0);
  const Matrix3Xd& x1 = scene.fields[Side::primary].position;
  const Matrix3Xd& x2 = scene.fields[Side::secondary].position;
  Segments segments(0);
  const auto sees_at = [&](double gap) {
    const Matrix3Xd away = x2.colwise() + gap * middle_normal(FacetType::quad4, x1);
    return !segments.search(facets_of(scene), {x1, away}, Reach(1, 0)).pairs().empty();
  };
  const double within = 0.9 * parallel_reach;
  const double beyond = 1.1 * parallel_reach;
  for (const bool finds_more : {false, true}) {
    BOOST_TEST(sees_at(within));
    BOOST_TEST(!segments.keep_lost_points());
    BOOST_TEST(!sees_at(beyond));
    BOOST_TEST(segments.keep_lost_points() == finds_more);
  }
  BOOST_TEST(sees_at(beyond));
  BOOST_TEST(!segments.keep_lost_points());
  BOOST_TEST(segments.end_iterations());
  BOOST_TEST(!sees_at(beyond));
  BOOST_TEST(!segments.end_iterations());
}

BOOST_AUTO_TEST_CASE(points_on_the_same_facets_are_those_of_the_search) {
  std::mt19937 random(3);
  Scene scene = squares(FacetType::quad4, FacetType::tri6, 2, 3);
  scene.disturb(0.03, random);
  const Matrix3Xd& x1 = scene.fields[Side::primary].position;
  const Matrix3Xd& x2 = scene.fields[Side::secondary].position;
  Segments segments(0);
  const FacetPairs found = segments.search(facets_of(scene), {x1, x2}, 1);
  const FacetPairs again = segments.on_same_facets(facets_of(scene), {x1, x2});
  BOOST_TEST_REQUIRE(found.pairs().size() == again.pairs().size());
  for (Index i = 0; i < found.pairs().count(); ++i) {
    BOOST_TEST(found.pairs()[i].secondary == again.pairs()[i].secondary);
    BOOST_TEST(found.pairs()[i].points == again.pairs()[i].points);
  }
}

BOOST_AUTO_TEST_CASE(tangents_are_exact_where_facets_count_in_part) {
  std::mt19937 random(10);
  for (const Integration integration : {Integration::segments, Integration::gauss}) {
    for (const FacetType type : {FacetType::tri3, FacetType::quad4, FacetType::quad8}) {
      Scene scene = turned_squares(type, type, random);
      scene.settings.integration = integration;
      scene.settings.search.radius = 3;
      Matrix3Xd& x2 = scene.fields[Side::secondary].position;
      const Vector3d middle(0.5, 0.5, 0);
      const Eigen::AngleAxisd tilt(std::acos(0.54), Vector3d::UnitY());
      x2 = (tilt.toRotationMatrix() * (x2.colwise() - middle)).colwise() + Vector3d(0.5, 0.5, -0.8);
      BOOST_TEST(!scene.contact()->pass(0).pairs().empty());
      BOOST_TEST_CONTEXT(static_cast<int>(integration) << " of " << static_cast<int>(type)) {
        BOOST_TEST(tangent_error(scene, fine_differences) <= difference_tolerance);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(points_move_as_their_motion_says) {
  std::mt19937 random(10);
  for (const auto& [one, two] : facet_pairs(all_facets, differently_cut)) {
    const Scene scene = turned_squares(one, two, random);
    Vector2d error(0, 0);
    for (const Facet& secondary : scene.mesh[Side::secondary].facets) {
      error += motion_error(LonePair(scene, scene.mesh[Side::primary].facets.front(), secondary));
    }
    BOOST_TEST_CONTEXT(static_cast<int>(one) << " on " << static_cast<int>(two)) {
      BOOST_TEST(std::sqrt(error[0] / error[1]) <= difference_tolerance);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_tangent_holds_the_motion_of_the_segments_corners) {
  std::mt19937 random(11);
  for (const FacetType type : differently_cut) {
    BOOST_TEST_CONTEXT(static_cast<int>(type)) {
      BOOST_TEST(tangent_error(turned_squares(type, type, random)) <= difference_tolerance);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_tangent_is_exact_for_turned_and_partly_covered_surfaces) {
  std::mt19937 random(12);
  Scene scene = squares(FacetType::quad4, FacetType::tri3, 2, 3, 0.08);
  turn(scene.fields[Side::secondary].position, 0.5);
  scene.disturb(0.01, random);
  BOOST_TEST(tangent_error(scene) <= difference_tolerance);
}

BOOST_AUTO_TEST_CASE(facets_are_unbroken_where_the_other_surface_covers_them_wholly) {
  std::mt19937 random(14);
  for (const double size : {0.7, 1.0, 1.1, 1.6, 2.0}) {
    const Scene scene = turned_beneath(FacetType::tri3, FacetType::tri3, size, random);
    const FacetPairs found = pairs_with_neighbours(scene);
    std::map<int, double> covered;
    for (const FacetPair& pair : found.pairs()) {
      for (const IntegrationPoint& point : found.points(pair)) covered[pair.primary] += point.weight;
    }
    for (const FacetPair& pair : found.pairs()) {
      const bool is_covered = covered[pair.primary] > 0.5 * (1 - 1e-9);  // of the parametric domain
      BOOST_TEST(pair.unbroken == is_covered);
    }
  }
}

BOOST_AUTO_TEST_CASE(facets_that_end_together_are_unbroken) {
  for (const auto& [cells_one, cells_two] : divisions) {
    const FacetPairs found = pairs_with_neighbours(squares(FacetType::tri3, FacetType::tri3, cells_one, cells_two));
    for (const FacetPair& pair : found.pairs()) BOOST_TEST(pair.unbroken);
  }
}

BOOST_AUTO_TEST_CASE(pairs_whose_rule_is_not_exact_count_as_broken) {
  std::mt19937 random(15);
  const auto is_any_unbroken = [](const FacetPairs& found) {
    return std::any_of(found.pairs().begin(), found.pairs().end(), [](const FacetPair& pair) { return pair.unbroken; });
  };
  for (const auto& [one, two] : facet_pairs()) {
    const bool flat = one == FacetType::tri3 && two == FacetType::tri3;
    BOOST_TEST(is_any_unbroken(pairs_with_neighbours(turned_beneath(one, two, 2, random))) == flat);
  }
  const Scene flat = turned_beneath(FacetType::tri3, FacetType::tri3, 2, random);
  BOOST_TEST(!is_any_unbroken(pairs_with_neighbours(flat, 1)));
  BOOST_TEST(is_any_unbroken(pairs_with_neighbours(flat, 4)));
  BOOST_TEST(!is_any_unbroken(pairs_of(flat)));
}

BOOST_AUTO_TEST_CASE(points_of_unbroken_pairs_may_count_as_fixed) {
  std::mt19937 random(16);
  for (const double size : {0.7, 1.1, 2.0}) {
    const Scene scene = turned_beneath(FacetType::tri3, FacetType::tri3, size, random);
    BOOST_TEST(tangent_error(scene) <= difference_tolerance);
  }
}

BOOST_AUTO_TEST_CASE(a_sliver_does_not_keep_ambient_values_from_the_nodes_beyond_it) {
  // The other surface ends at the edge of facets, plus a slip. Nodes on that line are flux-coupled, nodes beyond are
  // not.
  for (const double slip : {1e-12, 1e-7, 1e-2}) {
    PerSide<Grid> grids = facing_grids(FacetType::quad4, FacetType::quad4, 0.0625, 2, 1);
    grids[Side::secondary].high[0] = 0.5 + slip;
    Scene scene(grids, effects_of(true, 1), explicit_settings(4, 2, 8));
    scene.settings.integration = Integration::segments;
    const auto contact = scene.contact();
    contact->begin_iteration(scene.fields);
    const std::vector<bool> coupled = contact->nodes_in_contact()[Side::primary];
    const Matrix3Xd& x = scene.fields[Side::primary].position;
    for (Index node = 0; node < x.cols(); ++node)
      BOOST_TEST(coupled[static_cast<std::size_t>(node)] == (x(0, node) < 0.75));
  }
}

BOOST_AUTO_TEST_CASE(nodes_covered_least_bear_nothing_unless_they_are_far_away) {
  // Two facets are adjacent along x, and half of the second one is covered. The covered part is 0.125/0.5 of the area
  // of the nodes at its end, which have half an edge on one side of them, and (0.25 + 0.1875)/0.5 of that of the middle
  // nodes.
  for (const double away : {0.0, 0.5}) {
    PerSide<Grid> grids = facing_grids(FacetType::quad4, FacetType::quad4, 0.0625, 2, 1);
    grids[Side::secondary].high[0] = 0.75;
    Scene scene(grids, effects_of(true, 1), explicit_settings(4, 2, 8));
    scene.settings.integration = Integration::segments;
    Matrix3Xd& x2 = scene.fields[Side::secondary].position;
    for (Index node = 0; node < x2.cols(); ++node) x2(2, node) += away * x2(0, node);
    ContactPass pass(scene.mesh[Side::primary], scene.mesh[Side::secondary], scene.effects, scene.settings);
    const Matrix3Xd& x1 = scene.fields[Side::primary].position;
    pass.project({x1, x2}, 1);
    const std::vector<Facet>& facets = scene.mesh[Side::primary].facets;
    const Vector2d xi(0.2, -0.6);
    for (std::size_t f = 0; f < facets.size(); ++f) {
      const FacetVector x = facet_coordinates(facets[f], x1).row(0).transpose();
      const FacetVector psi = pass.space().shape(static_cast<int>(f), 0, xi).value;
      const double at_the_end = (x.array() > 0.75).select(psi, 0).sum();
      const double before = (x.array() > 0.75).select(shape_functions(facets[f].type, xi).value, 0).sum();
      BOOST_TEST(at_the_end == (away > 0 ? before : 0));
    }
  }
}

BOOST_AUTO_TEST_CASE(the_tangent_is_exact_where_nodes_are_hardly_covered) {
  // A fifth of the facets beyond the middle is covered: 0.02 of the area of the nodes at their far end.
  PerSide<Grid> grids = facing_grids(FacetType::quad4, FacetType::quad4, 0.08, 2, 1);
  grids[Side::secondary].high[0] = 0.6;
  Scene scene(grids, effects_of(true, 1), explicit_settings(4, 2, 8));
  scene.settings.integration = Integration::segments;
  std::mt19937 random(5);
  scene.disturb(0.01, random);
  BOOST_TEST(tangent_error(scene, fine_differences) <= difference_tolerance);
  const auto contact = scene.contact();
  contact->begin_iteration(scene.fields);
  const std::vector<bool> coupled = contact->nodes_in_contact()[Side::primary];
  BOOST_TEST(std::count(coupled.begin(), coupled.end(), false) == 3);
}
