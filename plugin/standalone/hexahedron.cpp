#include "hexahedron.h"

#include "contact/geometry/quadrature.h"

#include <Eigen/Geometry>

#include <array>

namespace standalone {
namespace {

/// Parametric coordinates of the 20 nodes; 0 along the edge of a mid-edge node.
constexpr std::array<std::array<int, 3>, 20> node_xi{{
    {-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1},  // corners
    {0, -1, -1},  {1, 0, -1},  {0, 1, -1}, {-1, 0, -1},                                                  // lower edges
    {0, -1, 1},   {1, 0, 1},   {0, 1, 1},  {-1, 0, 1},                                                   // upper edges
    {-1, -1, 0},  {1, -1, 0},  {1, 1, 0},  {-1, 1, 0},  // vertical edges
}};

/// A factor of a shape function in one coordinate, (1 + xi xi_a) or (1 - xi^2), and its derivative.
Eigen::Vector2d factor(double xi, int node) {
  if (node == 0) return {1 - xi * xi, -2 * xi};
  return {1 + xi * node, static_cast<double>(node)};
}

}  // namespace

Eigen::Matrix4Xd hexahedron_shape(int nodes, const Eigen::Vector3d& xi) {
  Eigen::Matrix4Xd shape(4, nodes);
  for (int a = 0; a < nodes; ++a) {
    const auto& place = at(node_xi, a);
    const Eigen::Vector2d r = factor(xi[0], place[0]);
    const Eigen::Vector2d s = factor(xi[1], place[1]);
    const Eigen::Vector2d t = factor(xi[2], place[2]);
    const Eigen::Vector4d product(r[0] * s[0] * t[0], r[1] * s[0] * t[0], r[0] * s[1] * t[0], r[0] * s[0] * t[1]);
    if (a >= 8) {
      shape.col(a) = product / 4;
    } else if (nodes == 8) {
      shape.col(a) = product / 8;
    } else {  // a corner of 20 nodes; the function vanishes at the mid-edge nodes
      const double plane = xi[0] * place[0] + xi[1] * place[1] + xi[2] * place[2] - 2;
      shape.col(a) = product * plane / 8;
      for (int i = 0; i < 3; ++i) shape(1 + i, a) += product[0] * at(place, i) / 8;
    }
  }
  return shape;
}

std::vector<HexahedronPoint> hexahedron_rule(int nodes) {
  const Eigen::MatrixX2d line = mixture_contact::gauss_legendre(nodes == 8 ? 2 : 3);
  std::vector<HexahedronPoint> rule;
  for (Eigen::Index k = 0; k < line.rows(); ++k) {
    for (Eigen::Index j = 0; j < line.rows(); ++j) {
      for (Eigen::Index i = 0; i < line.rows(); ++i) {
        rule.push_back({{line(i, 0), line(j, 0), line(k, 0)}, line(i, 1) * line(j, 1) * line(k, 1)});
      }
    }
  }
  return rule;
}

std::vector<FacetPoint> facet_points(const mixture_contact::Facet& facet, const Eigen::Matrix3Xd& positions) {
  using namespace mixture_contact;
  const FacetCoordinates x = facet_coordinates(facet, positions);
  std::vector<FacetPoint> points;
  for (const QuadraturePoint& point : quadrature(facet.type, default_quadrature_order(facet.type))) {
    const ShapeFunctions shape = shape_functions(facet.type, point.xi);
    const Eigen::Matrix<double, 3, 2> tangents = x * shape.gradient;
    points.push_back({shape.value, point.weight * tangents.col(0).cross(tangents.col(1))});
  }
  return points;
}

}  // namespace standalone
