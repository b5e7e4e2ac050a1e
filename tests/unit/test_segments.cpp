#include "contact/segments.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

#include <Eigen/Geometry>

using namespace test;

namespace {

/// Sums over hundreds of points, each the outcome of a few dozen operations, are exact to this.
constexpr double exact = 1e-12;

constexpr std::array<std::pair<int, int>, 5> divisions{{{1, 1}, {2, 3}, {3, 4}, {4, 3}, {7, 5}}};

/// Facing unit squares with different divisions.
Scene squares(FacetType one, FacetType two, int cells_one, int cells_two, double overlap = 0.0625) {
  Settings settings = explicit_settings(4, 2, 8);
  settings.integration = Integration::segments;
  return {facing_grids(one, two, overlap, cells_one, cells_two), effects_of(true, 1), settings};
}

std::vector<FacetPair> pairs_of(const Scene& scene, int order = 0) {
  return Segments(scene.mesh[Side::primary].facets, scene.mesh[Side::secondary].facets, order)
      .search(scene.fields[Side::primary].position, scene.fields[Side::secondary].position, 1);
}

/// Kinematics at the points of all pairs.
void for_each_point(
    const Scene& scene, const std::vector<FacetPair>& pairs,
    const std::function<void(const Facet&, const Facet&, const IntegrationPoint&, const PointKinematics&)>& use) {
  for (const FacetPair& pair : pairs) {
    const Facet& one = scene.mesh[Side::primary].facets[static_cast<std::size_t>(pair.primary)];
    const Facet& two = scene.mesh[Side::secondary].facets[static_cast<std::size_t>(pair.secondary)];
    for (const IntegrationPoint& point : pair.points) {
      use(one, two, point,
          point_kinematics(
              shape_functions(one.type, point.xi), facet_coordinates(one, scene.fields[Side::primary].position),
              shape_functions(two.type, point.eta), facet_coordinates(two, scene.fields[Side::secondary].position)));
    }
  }
}

/// INT psi_a f(x) da per node over a whole surface, by Gauss rules of high order piece by piece.
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

/// Turns a surface about the z axis through the middle of the unit square.
void turn(Matrix3Xd& position, double angle) {
  const Vector3d middle(0.5, 0.5, 0);
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
  position = (rotation * (position.colwise() - middle)).colwise() + middle;
}

/// Residual of a scene's contact with the status of its nodes held against its tangent.
double tangent_error(const Scene& scene) {
  const auto contact = scene.contact();
  contact->begin_iteration(scene.fields);
  const GlobalLayout layout(scene);
  const VectorXd q = layout.pack(scene.fields);
  const MatrixXd approximate = differences(
      [&](const VectorXd& at) {
        const PerSide<SurfaceFields> fields = layout.unpack(at);
        contact->project({{fields[Side::primary].position, fields[Side::secondary].position}});
        return assembled_residual(*contact, layout, fields, 0.3);
      },
      q);
  contact->project(scene.position());
  const MatrixXd tangent = assembled_tangent(*contact, layout, scene.fields, 0.3);
  return (tangent - approximate).norm() / tangent.norm();
}

}  // namespace

BOOST_AUTO_TEST_CASE(pieces_cover_facing_squares_exactly_whatever_their_divisions) {
  for (const FacetType one : all_facets) {
    for (const FacetType two : all_facets) {
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
}

BOOST_AUTO_TEST_CASE(weighted_integrals_of_an_affine_gap_are_exact) {
  const auto gap = [](const Vector3d& x) { return 0.3 * x[0] - 0.2 * x[1] - 0.1; };
  for (const FacetType one : all_facets) {
    for (const FacetType two : all_facets) {
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
        const VectorXd expected = nodal_integrals(scene.mesh[Side::primary], scene.fields[Side::primary].position,
                                                  false, gap);
        BOOST_TEST((sum - expected).norm() <= exact);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_uniform_load_reaches_the_nodes_of_the_other_side_exactly) {
  for (const FacetType one : all_facets) {
    for (const FacetType two : all_facets) {
      for (const auto& [cells_one, cells_two] : divisions) {
        const Scene scene = squares(one, two, cells_one, cells_two);
        VectorXd sum = VectorXd::Zero(scene.mesh[Side::secondary].nodes);
        for_each_point(
            scene, pairs_of(scene),
            [&](const Facet&, const Facet& facet, const IntegrationPoint& place, const PointKinematics& point) {
              for (Index b = 0; b < point.secondary_shape.size(); ++b) {
                sum[facet.nodes[static_cast<std::size_t>(b)]] += place.weight * point.area * point.secondary_shape[b];
              }
            });
        const VectorXd expected = nodal_integrals(scene.mesh[Side::secondary], scene.fields[Side::secondary].position,
                                                  true, [](const Vector3d&) { return 1.0; });
        BOOST_TEST((sum - expected).norm() <= exact);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_smaller_square_turned_in_the_plane_is_covered_exactly) {
  for (const FacetType one : all_facets) {
    for (const FacetType two : all_facets) {
      Scene scene = squares(one, two, 3, 2);
      Matrix3Xd& x2 = scene.fields[Side::secondary].position;
      x2.topRows<2>() = (0.6 * x2.topRows<2>().array() + 0.2).matrix();
      turn(x2, 0.5);
      double area = 0;
      VectorXd sum = VectorXd::Zero(scene.mesh[Side::secondary].nodes);
      for_each_point(
          scene, pairs_of(scene),
          [&](const Facet&, const Facet& facet, const IntegrationPoint& place, const PointKinematics& point) {
            area += place.weight * point.area;
            for (Index b = 0; b < point.secondary_shape.size(); ++b) {
              sum[facet.nodes[static_cast<std::size_t>(b)]] += place.weight * point.area * point.secondary_shape[b];
            }
          });
      BOOST_TEST(std::abs(area - 0.36) <= exact);
      const VectorXd expected = nodal_integrals(scene.mesh[Side::secondary], x2, true,
                                                [](const Vector3d&) { return 1.0; });
      BOOST_TEST((sum - expected).norm() <= exact);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_surface_covered_in_part_carries_the_exact_force_and_flows) {
  for (const FacetType one : all_facets) {
    for (const FacetType two : all_facets) {
      Scene scene = squares(one, two, 3, 2);
      Matrix3Xd& x2 = scene.fields[Side::secondary].position;
      x2.topRows<2>() = (0.6 * x2.topRows<2>().array() + 0.2).matrix();
      turn(x2, 0.5);
      scene.set_field(0, 0.5, 0.25);
      const Balance balance = scene.contact()->balance(scene.fields);
      BOOST_TEST(std::abs(balance.area - 0.36) <= exact);
      BOOST_TEST((balance.force - Vector3d(0, 0, -4 * 0.0625 * 0.36)).norm() <= exact);
      BOOST_TEST(std::abs(balance.flow[0] - 2 * 0.25 * 0.36) <= exact);
      const GlobalLayout layout(scene);
      const VectorXd residual = assembled_residual(*scene.contact(), layout, scene.fields, 1);
      // The loads of the covering surface's nodes are those of a uniform traction and flux.
      const VectorXd shares = nodal_integrals(scene.mesh[Side::secondary], x2, true,
                                              [](const Vector3d&) { return 1.0; });
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
}

BOOST_AUTO_TEST_CASE(facets_that_face_away_or_lie_behind_others_are_left_out) {
  Scene scene = squares(FacetType::quad4, FacetType::quad4, 2, 3);
  SurfaceMesh& mesh = scene.mesh[Side::secondary];
  Matrix3Xd& x2 = scene.fields[Side::secondary].position;
  // A second, farther layer of the same facets, and a third one between them that faces away.
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
  for (const FacetPair& pair : pairs_of(scene)) BOOST_TEST(pair.secondary < static_cast<int>(first.size()));
  BOOST_TEST(pairs_of(scene).size() == 16U);
}

BOOST_AUTO_TEST_CASE(facets_out_of_reach_are_not_seen) {
  const Scene scene = squares(FacetType::quad4, FacetType::quad4, 2, 3, -1.5);
  BOOST_TEST(pairs_of(scene).empty());
}

BOOST_AUTO_TEST_CASE(points_on_the_same_facets_are_those_of_the_search) {
  std::mt19937 random(3);
  Scene scene = squares(FacetType::quad4, FacetType::tri6, 2, 3);
  scene.disturb(0.03, random);
  const Matrix3Xd& x1 = scene.fields[Side::primary].position;
  const Matrix3Xd& x2 = scene.fields[Side::secondary].position;
  Segments segments(scene.mesh[Side::primary].facets, scene.mesh[Side::secondary].facets, 0);
  const std::vector<FacetPair> found = segments.search(x1, x2, 1);
  const std::vector<FacetPair> again = segments.on_same_facets(x1, x2);
  BOOST_TEST_REQUIRE(found.size() == again.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    BOOST_TEST(found[i].secondary == again[i].secondary);
    BOOST_TEST(found[i].points.size() == again[i].points.size());
  }
}

BOOST_AUTO_TEST_CASE(the_tangent_holds_the_motion_of_the_segments_corners) {
  std::mt19937 random(11);
  double worst = 0;
  for (const FacetType one : all_facets) {
    for (const FacetType two : all_facets) {
      // Turned, so that edges cross at an angle: the third derivatives of a crossing grow with its cube.
      Scene scene = squares(one, two, 1, 2, 0.08);
      turn(scene.fields[Side::secondary].position, 0.5);
      scene.disturb(0.02, random);
      const double error = tangent_error(scene);
      BOOST_TEST_MESSAGE(static_cast<int>(one) << " " << static_cast<int>(two) << ": " << error);
      worst = std::max(worst, error);
    }
  }
  BOOST_TEST_MESSAGE("largest relative difference " << worst);
  BOOST_TEST(worst <= difference_tolerance);
}

BOOST_AUTO_TEST_CASE(the_tangent_is_exact_for_turned_and_partly_covered_surfaces) {
  std::mt19937 random(12);
  Scene scene = squares(FacetType::quad4, FacetType::tri3, 2, 3, 0.08);
  turn(scene.fields[Side::secondary].position, 0.5);
  scene.disturb(0.01, random);
  BOOST_TEST(tangent_error(scene) <= difference_tolerance);
}
