#include "standalone/hexahedron.h"

#include <boost/test/unit_test.hpp>

#include <random>

using namespace standalone;

namespace {

const std::array<int, 2> node_counts{8, 20};

Eigen::Vector3d random_point(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  return {unit(random), unit(random), unit(random)};
}

/// Parametric coordinates of a node: the point at which its own shape function is one.
Eigen::Vector3d node_position(int nodes, int node) {
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      for (int k = -1; k <= 1; ++k) {
        const Eigen::Vector3d xi(i, j, k);
        if (std::abs(hexahedron_shape(nodes, xi)(0, node) - 1) < 1e-12) return xi;
      }
    }
  }
  BOOST_FAIL("no node there");
  return {};
}

}  // namespace

BOOST_AUTO_TEST_CASE(each_shape_function_is_one_at_its_node_and_zero_at_the_others) {
  for (const int nodes : node_counts) {
    for (int a = 0; a < nodes; ++a) {
      const Eigen::Matrix4Xd shape = hexahedron_shape(nodes, node_position(nodes, a));
      for (int b = 0; b < nodes; ++b)
        BOOST_TEST(shape(0, b) == (a == b ? 1.0 : 0.0), boost::test_tools::tolerance(1e-14));
    }
  }
}

BOOST_AUTO_TEST_CASE(shape_functions_add_up_to_one_and_reproduce_positions) {
  std::mt19937 random(1);
  for (const int nodes : node_counts) {
    Eigen::Matrix3Xd x(3, nodes);
    for (int a = 0; a < nodes; ++a) x.col(a) = node_position(nodes, a);
    for (int trial = 0; trial < 20; ++trial) {
      const Eigen::Vector3d xi = random_point(random);
      const Eigen::Matrix4Xd shape = hexahedron_shape(nodes, xi);
      BOOST_TEST((shape.rowwise().sum() - Eigen::Vector4d(1, 0, 0, 0)).norm() < 1e-13);
      BOOST_TEST((x * shape.row(0).transpose() - xi).norm() < 1e-13);
      BOOST_TEST((x * shape.bottomRows(3).transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-13);
    }
  }
}

BOOST_AUTO_TEST_CASE(derivatives_are_those_of_the_shape_functions) {
  std::mt19937 random(2);
  const double h = 1e-5;
  for (const int nodes : node_counts) {
    const Eigen::Vector3d xi = random_point(random);
    const Eigen::Matrix4Xd shape = hexahedron_shape(nodes, xi);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(i);
      const Eigen::RowVectorXd slope = (hexahedron_shape(nodes, xi + step).row(0) -
                                        hexahedron_shape(nodes, xi - step).row(0)) /
                                       (2 * h);
      BOOST_TEST((slope - shape.row(1 + i)).norm() < 1e-9);
    }
  }
}

BOOST_AUTO_TEST_CASE(rules_are_exact_to_their_degree) {
  for (const int nodes : node_counts) {
    const int degree = nodes == 8 ? 3 : 5;
    const auto rule = hexahedron_rule(nodes);
    BOOST_TEST(rule.size() == (nodes == 8 ? 8U : 27U));
    for (int power = 0; power <= degree; ++power) {
      double sum = 0;
      for (const HexahedronPoint& point : rule)
        sum += point.weight * std::pow(point.xi[0], power) * std::pow(point.xi[2], power);
      const double line = power % 2 == 0 ? 2.0 / (power + 1) : 0.0;
      BOOST_TEST(std::abs(sum - 2 * line * line) < 1e-13);
    }
  }
}
