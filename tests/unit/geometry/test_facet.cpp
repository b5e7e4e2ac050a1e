#include "contact/geometry/facet.h"

#include "surfaces.h"

#include <boost/test/unit_test.hpp>

using namespace test;

namespace {

/// Nodes of FEBio's FESurfaceElement, from its shape function tables.
const std::vector<Vector2d> febio_triangle{
    {0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}, {1.0 / 3.0, 1.0 / 3.0}};
const std::vector<Vector2d> febio_quadrilateral{{-1, -1}, {1, -1}, {1, 1},  {-1, 1}, {0, -1},
                                                {1, 0},   {0, 1},  {-1, 0}, {0, 0}};

/// Exponents of the monomials that a facet type has to reproduce.
std::vector<std::array<int, 2>> complete_monomials(FacetType type) {
  std::vector<std::array<int, 2>> monomials{{0, 0}, {1, 0}, {0, 1}};
  if (!is_triangle(type)) monomials.push_back({1, 1});
  if (edge_degree(type) == 2) monomials.insert(monomials.end(), {{1, 1}, {2, 0}, {0, 2}});
  if (type == FacetType::quad8 || type == FacetType::quad9) monomials.insert(monomials.end(), {{2, 1}, {1, 2}});
  if (type == FacetType::quad9) monomials.push_back({2, 2});
  return monomials;
}

double monomial(const std::array<int, 2>& exponents, const Vector2d& x) {
  return std::pow(x[0], exponents[0]) * std::pow(x[1], exponents[1]);
}

}  // namespace

BOOST_AUTO_TEST_CASE(shape_functions_are_a_partition_of_unity) {
  std::mt19937 random(1);
  for (const FacetType type : all_facets) {
    for (int sample = 0; sample < 50; ++sample) {
      const ShapeFunctions shape = shape_functions(type, 1.1 * random_inside(type, random));
      BOOST_TEST(std::abs(shape.value.sum() - 1) <= rounding);
      BOOST_TEST(shape.gradient.colwise().sum().cwiseAbs().maxCoeff() <= rounding);
    }
  }
}

BOOST_AUTO_TEST_CASE(shape_functions_are_one_at_their_own_node_and_zero_at_the_others) {
  for (const FacetType type : all_facets) {
    for (int node = 0; node < node_count(type); ++node) {
      const ShapeFunctions shape = shape_functions(type, parametric_node(type, node));
      const VectorXd own = VectorXd::Unit(node_count(type), node);
      BOOST_TEST((shape.value - own).cwiseAbs().maxCoeff() <= rounding);
    }
  }
}

BOOST_AUTO_TEST_CASE(nodes_are_numbered_as_in_febio) {
  for (const FacetType type : all_facets) {
    const std::vector<Vector2d>& expected = is_triangle(type) ? febio_triangle : febio_quadrilateral;
    for (int node = 0; node < node_count(type); ++node) {
      BOOST_TEST((parametric_node(type, node) == expected[static_cast<std::size_t>(node)]));
    }
  }
}

BOOST_AUTO_TEST_CASE(gradients_are_the_differences_of_the_values) {
  std::mt19937 random(2);
  for (const FacetType type : all_facets) {
    for (int sample = 0; sample < 50; ++sample) {
      const Vector2d xi = random_inside(type, random);
      for (int i = 0; i < 2; ++i) {
        // The functions are at most quadratic in each coordinate: central differences have no truncation error, and the
        // step may be large.
        const Vector2d step = 0.5 * Vector2d::Unit(i);
        const FacetVector difference = shape_functions(type, xi + step).value - shape_functions(type, xi - step).value;
        BOOST_TEST((shape_functions(type, xi).gradient.col(i) - difference).cwiseAbs().maxCoeff() <= rounding);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(second_derivatives_are_the_differences_of_the_gradients) {
  std::mt19937 random(3);
  for (const FacetType type : all_facets) {
    const Vector2d xi = random_inside(type, random);
    const MatrixXd slopes = differences(
        [&](const VectorXd& at) {
          const FacetGradient gradient = shape_functions(type, at).gradient;
          return VectorXd(gradient.reshaped());
        },
        xi);
    const FacetHessian hessian = shape_hessian(type, xi);
    const Index n = hessian.rows();
    MatrixXd expected(2 * n, 2);
    expected << hessian.col(0), hessian.col(2), hessian.col(2), hessian.col(1);
    BOOST_TEST((slopes - expected).norm() <= difference_tolerance);
  }
}

BOOST_AUTO_TEST_CASE(complete_polynomials_are_reproduced) {
  std::mt19937 random(3);
  for (const FacetType type : all_facets) {
    for (const auto& exponents : complete_monomials(type)) {
      FacetVector nodal(node_count(type));
      for (int node = 0; node < node_count(type); ++node)
        nodal[node] = monomial(exponents, parametric_node(type, node));
      const Vector2d xi = random_inside(type, random);
      BOOST_TEST(std::abs(shape_functions(type, xi).value.dot(nodal) - monomial(exponents, xi)) <= rounding);
    }
  }
}

BOOST_AUTO_TEST_CASE(facet_types_are_found_by_shape_and_node_count) {
  for (const FacetType type : all_facets) {
    BOOST_TEST((facet_type(is_triangle(type), node_count(type)) == type));
    BOOST_TEST(shape_functions(type, parametric_centre(type)).value.size() == node_count(type));
    BOOST_TEST(distance_outside(type, parametric_centre(type)) == 0.0);
  }
  BOOST_TEST(!facet_type(true, 4));
  BOOST_TEST(!facet_type(false, 3));
  BOOST_TEST(!facet_type(true, 10));
}

BOOST_AUTO_TEST_CASE(an_unknown_facet_type_is_an_error) {
  const auto unknown = static_cast<FacetType>(99);
  BOOST_CHECK_THROW(node_count(unknown), std::logic_error);
  BOOST_CHECK_THROW(shape_functions(unknown, {0, 0}), std::logic_error);
}

BOOST_AUTO_TEST_CASE(distance_outside_is_measured_in_parametric_coordinates) {
  BOOST_TEST(distance_outside(FacetType::quad8, {1, -1}) == 0.0);
  BOOST_TEST(distance_outside(FacetType::quad4, {1.25, 0}) == 0.25);
  BOOST_TEST(distance_outside(FacetType::quad4, {0, -1.5}) == 0.5);
  BOOST_TEST(distance_outside(FacetType::tri3, {0.5, 0.5}) == 0.0);
  BOOST_TEST(distance_outside(FacetType::tri3, {0.75, 0.5}) == 0.25);
  BOOST_TEST(distance_outside(FacetType::tri6, {-0.25, 0.5}) == 0.25);
  BOOST_TEST(distance_outside(FacetType::tri6, {0.5, -0.125}) == 0.125);
}

BOOST_AUTO_TEST_CASE(a_facet_picks_its_nodes_in_its_own_order) {
  Facet facet;
  facet.type = FacetType::tri3;
  facet.nodes = {4, 0, 2};
  const Matrix3Xd positions = Matrix3Xd::Random(3, 5);
  const VectorXd field = VectorXd::Random(5);
  const FacetCoordinates x = facet_coordinates(facet, positions);
  const FacetVector values = facet_values(facet, field);
  BOOST_TEST(x.cols() == 3);
  for (int a = 0; a < 3; ++a) {
    const int node = facet.nodes[static_cast<std::size_t>(a)];
    BOOST_TEST((x.col(a) == positions.col(node)));
    BOOST_TEST(values[a] == field[node]);
  }
}
