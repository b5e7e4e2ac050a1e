#include "contact/geometry/sub_facets.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

using namespace test;

BOOST_AUTO_TEST_CASE(an_outline_goes_around_by_corners_and_the_middles_between_them) {
  for (const FacetType type : all_facets) {
    const std::vector<int>& nodes = outline(type);
    const std::size_t corners = is_triangle(type) ? 3 : 4;
    const std::size_t per_edge = nodes.size() / corners;
    BOOST_TEST(nodes.size() == corners * static_cast<std::size_t>(edge_degree(type)));
    for (std::size_t i = 0; i < corners; ++i) {
      BOOST_TEST(nodes[per_edge * i] == static_cast<int>(i));
      if (per_edge == 1) continue;
      const Vector2d ends = parametric_node(type, nodes[2 * i]) +
                            parametric_node(type, nodes[(2 * i + 2) % nodes.size()]);
      BOOST_TEST((parametric_node(type, nodes[2 * i + 1]) - 0.5 * ends).norm() <= rounding);
    }
  }
}

BOOST_AUTO_TEST_CASE(multiplier_functions_are_shares_that_are_nowhere_negative) {
  std::mt19937 random(4);
  for (const FacetType type : all_facets) {
    for (int sample = 0; sample < 200; ++sample) {
      const Vector2d xi = random_inside(type, random);
      const ShapeFunctions psi = multiplier_functions(type, sub_facet_at(type, xi), xi);
      BOOST_TEST(std::abs(psi.value.sum() - 1) <= rounding);
      BOOST_TEST(psi.value.minCoeff() >= -rounding);
      BOOST_TEST(psi.gradient.colwise().sum().cwiseAbs().maxCoeff() <= rounding);
    }
  }
}

BOOST_AUTO_TEST_CASE(multiplier_functions_are_linear_between_neighbouring_nodes) {
  for (const FacetType type : all_facets) {
    // For a linear function, interpolation of the nodal values gives the function, and the gradients give its slope.
    FacetVector nodal(node_count(type));
    for (int a = 0; a < node_count(type); ++a) nodal[a] = 2 * parametric_node(type, a)[0] - parametric_node(type, a)[1];
    for (const QuadraturePoint& q : piecewise_quadrature(type, 3)) {
      const ShapeFunctions psi = multiplier_functions(type, sub_facet_at(type, q.xi), q.xi);
      BOOST_TEST(std::abs(psi.value.dot(nodal) - (2 * q.xi[0] - q.xi[1])) <= rounding);
      BOOST_TEST((psi.gradient.transpose() * nodal - Vector2d(2, -1)).norm() <= rounding);
    }
    for (int a = 0; a < node_count(type); ++a) {
      const Vector2d place = parametric_node(type, a);
      BOOST_TEST(std::abs(multiplier_functions(type, sub_facet_at(type, place), place).value[a] - 1) <= rounding);
    }
  }
}

BOOST_AUTO_TEST_CASE(slopes_of_multiplier_functions_are_the_differences_of_the_values) {
  std::mt19937 random(5);
  for (const FacetType type : all_facets) {
    const Vector2d xi = random_inside(type, random);
    for (int piece = 0; piece < static_cast<int>(sub_facets(type).size()); ++piece) {
      for (int i = 0; i < 2; ++i) {
        // The functions are linear in each coordinate, also outside the piece: central differences have no truncation
        // error.
        const Vector2d step = 0.5 * Vector2d::Unit(i);
        const FacetVector difference = multiplier_functions(type, piece, xi + step).value -
                                       multiplier_functions(type, piece, xi - step).value;
        const FacetVector slope = multiplier_functions(type, piece, xi).gradient.col(i);
        BOOST_TEST((slope - difference).cwiseAbs().maxCoeff() <= rounding);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(functions_redistributed_among_some_nodes_add_up_to_one_with_their_slopes) {
  std::mt19937 random(6);
  for (const FacetType type : all_facets) {
    const Vector2d xi = random_inside(type, random);
    const int piece = sub_facet_at(type, xi);
    for (Index alone = 0; alone < node_count(type); ++alone) {
      FacetVector counts = FacetVector::Ones(node_count(type));
      counts[alone] = 0;
      const auto shared = [&](const Vector2d& at) {
        return redistributed(type, multiplier_functions(type, piece, at), counts);
      };
      const ShapeFunctions psi = shared(xi);
      BOOST_TEST(std::abs(psi.value.sum() - 1) <= rounding);
      BOOST_TEST(psi.value[alone] == 0.0);
      BOOST_TEST(psi.value.minCoeff() >= -rounding);
      for (int i = 0; i < 2; ++i) {
        // The functions are linear in each coordinate, as psi itself: central differences have no truncation error.
        const Vector2d step = 0.5 * Vector2d::Unit(i);
        const FacetVector difference = shared(xi + step).value - shared(xi - step).value;
        BOOST_TEST((psi.gradient.col(i) - difference).cwiseAbs().maxCoeff() <= rounding);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(functions_are_redistributed_beside_their_nodes_where_these_have_someone_there) {
  const Vector2d xi(0.2, -0.6);
  const auto shared = [&](const FacetVector& counts) {
    return redistributed(FacetType::quad4, shape_functions(FacetType::quad4, xi), counts).value;
  };
  // The nodes 1 and 2 of the far edge give their functions to the nodes across: the functions along the near edge
  // remain linear.
  const FacetVector edge = shared(Eigen::Vector4d(1, 0, 0, 1));
  BOOST_TEST((edge - FacetVector(Eigen::Vector4d(0.8, 0, 0, 0.2))).norm() <= rounding);
  const FacetVector corner = shared(Eigen::Vector4d(0, 1, 0, 0));
  BOOST_TEST((corner - FacetVector(Eigen::Vector4d(0, 1, 0, 0))).norm() <= rounding);
}
