#include "contact/geometry/quadrature.h"

#include "random_contact.h"

#include <boost/test/unit_test.hpp>

#include <string>

using namespace test;

namespace {

double factorial(int n) { return std::tgamma(n + 1.0); }

/// INT_-1^1 x^2n dx minus its n-point Gauss sum: 2^(2n+1) n!^4/((2n+1) (2n)!^2), the error term of the rule.
double gauss_defect(int points) {
  return std::pow(2, 2 * points + 1) * std::pow(factorial(points), 4) /
         ((2 * points + 1) * std::pow(factorial(2 * points), 2));
}

double gauss_sum(const Eigen::MatrixX2d& rule, int power) {
  return rule.col(0).array().pow(power).matrix().dot(rule.col(1));
}

double line_integral(int power) { return power % 2 == 0 ? 2.0 / (power + 1) : 0.0; }

/// The integral of r^i s^j over the parametric domain of a facet.
double exact_integral(FacetType type, int i, int j) {
  return is_triangle(type) ? factorial(i) * factorial(j) / factorial(i + j + 2) : line_integral(i) * line_integral(j);
}

double error(FacetType type, int order, int i, int j) {
  double sum = 0;
  for (const QuadraturePoint& q : quadrature(type, order)) {
    sum += q.weight * std::pow(q.xi[0], i) * std::pow(q.xi[1], j);
  }
  return std::abs(sum - exact_integral(type, i, j));
}

int triangle_degree(int order) { return order == 1 ? 1 : order == 2 ? 2 : order == 3 ? 5 : 2 * order - 2; }

}  // namespace

BOOST_AUTO_TEST_CASE(gauss_legendre_is_exact_to_its_degree_and_has_its_error_beyond) {
  for (int points = 1; points <= max_quadrature_order; ++points) {
    const Eigen::MatrixX2d rule = gauss_legendre(points);
    for (int power = 0; power < 2 * points; ++power) {
      BOOST_TEST(std::abs(gauss_sum(rule, power) - line_integral(power)) <= rounding);
    }
    const double defect = line_integral(2 * points) - gauss_sum(rule, 2 * points);
    BOOST_TEST(std::abs(defect - gauss_defect(points)) <= rounding);
    BOOST_TEST(gauss_defect(points) > 1e6 * rounding);  // the test above therefore detects the degree
  }
}

BOOST_AUTO_TEST_CASE(weights_are_positive_and_points_inside) {
  for (const FacetType type : all_facets) {
    for (int order = 1; order <= max_quadrature_order; ++order) {
      double area = 0;
      for (const QuadraturePoint& q : quadrature(type, order)) {
        BOOST_TEST(q.weight > 0);
        BOOST_TEST(distance_outside(type, q.xi) == 0.0);
        area += q.weight;
      }
      BOOST_TEST(std::abs(area - exact_integral(type, 0, 0)) <= rounding);
    }
  }
}

BOOST_AUTO_TEST_CASE(quadrilateral_rules_are_exact_to_their_degree_in_each_coordinate) {
  for (const FacetType type : {FacetType::quad4, FacetType::quad8, FacetType::quad9}) {
    for (int order = 1; order <= max_quadrature_order; ++order) {
      for (int i = 0; i < 2 * order; ++i) {
        for (int j = 0; j < 2 * order; ++j) BOOST_TEST(error(type, order, i, j) <= rounding);
      }
      BOOST_TEST(error(type, order, 2 * order, 0) > 1e3 * rounding);
      BOOST_TEST(error(type, order, 0, 2 * order) > 1e3 * rounding);
    }
  }
}

BOOST_AUTO_TEST_CASE(triangle_rules_are_exact_to_their_total_degree) {
  for (const FacetType type : {FacetType::tri3, FacetType::tri6, FacetType::tri7}) {
    for (int order = 1; order <= max_quadrature_order; ++order) {
      const int degree = triangle_degree(order);
      for (int i = 0; i <= degree; ++i) {
        for (int j = 0; i + j <= degree; ++j) BOOST_TEST(error(type, order, i, j) <= rounding);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(triangle_rules_are_not_exact_beyond_their_total_degree) {
  for (int order = 1; order <= 3; ++order) {
    BOOST_TEST(error(FacetType::tri3, order, triangle_degree(order) + 1, 0) > 1e6 * rounding);
  }
  for (int order = 4; order <= max_quadrature_order; ++order) {
    // r^(2n-1) (1 - r) has the degree 2n in r; its error on [0, 1] is that on [-1, 1] divided by 2^(2n+1). The integral
    // is 1/(2n (2n+1)), and its rounding error is smaller than `rounding` by that factor.
    const double defect = gauss_defect(order) / std::pow(2, 2 * order + 1);
    const double accuracy = rounding / (2 * order * (2 * order + 1));
    BOOST_TEST(std::abs(error(FacetType::tri6, order, 2 * order - 1, 0) - defect) <= accuracy);
    BOOST_TEST(defect > 1e3 * accuracy);
  }
}

BOOST_AUTO_TEST_CASE(the_number_of_points_is_as_stated) {
  BOOST_TEST(quadrature(FacetType::tri3, 1).size() == 1U);
  BOOST_TEST(quadrature(FacetType::tri6, 2).size() == 3U);
  BOOST_TEST(quadrature(FacetType::tri6, 3).size() == 7U);
  BOOST_TEST(quadrature(FacetType::tri3, 4).size() == 16U);
  BOOST_TEST(quadrature(FacetType::quad8, 3).size() == 9U);
}

BOOST_AUTO_TEST_CASE(an_order_out_of_range_is_an_error_that_names_it) {
  for (const FacetType type : all_facets) {
    for (const int order : {-1, 0, max_quadrature_order + 1}) {
      const auto names_it = [&](const std::invalid_argument& e) {
        return std::string(e.what()).find(" " + std::to_string(order) + " ") != std::string::npos;
      };
      BOOST_CHECK_EXCEPTION(quadrature(type, order), std::invalid_argument, names_it);
    }
  }
}

BOOST_AUTO_TEST_CASE(default_orders_follow_the_degree_of_the_facet) {
  BOOST_TEST(default_quadrature_order(FacetType::tri3) == 2);
  BOOST_TEST(default_quadrature_order(FacetType::quad4) == 2);
  BOOST_TEST(default_quadrature_order(FacetType::tri6) == 3);
  BOOST_TEST(default_quadrature_order(FacetType::tri7) == 3);
  BOOST_TEST(default_quadrature_order(FacetType::quad8) == 3);
  BOOST_TEST(default_quadrature_order(FacetType::quad9) == 3);
}
