#include "geometry/facet.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace mixture_contact {
namespace {

constexpr std::array all_types{FacetType::tri3,  FacetType::tri6,  FacetType::tri7,
                               FacetType::quad4, FacetType::quad8, FacetType::quad9};

/// A function of one coordinate with its derivatives.
struct Value {
  double value;
  double derivative;
  double second;
};

/// Signs of the corner coordinates of a quadrilateral, in node order.
constexpr std::array<std::array<double, 2>, 4> corner_sign{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

/// Positions (-1, 0 or 1) of the nodes of a quad9 on its 3 x 3 grid, in node order.
constexpr std::array<std::array<int, 2>, 9> quad9_grid{
    {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}}};

/// Quadratic Lagrange polynomial on {-1, 0, 1} that is 1 at the given node.
Value lagrange_quadratic(int node, double x) {
  if (node == 0) return {1 - x * x, -2 * x, -2};
  return {0.5 * x * (x + node), x + 0.5 * node, 1};
}

ShapeFunctions sized(FacetType type) {
  ShapeFunctions shape;
  shape.value.resize(node_count(type));
  shape.gradient.resize(node_count(type), 2);
  return shape;
}

ShapeFunctions tri3(const Vector2d& xi) {
  ShapeFunctions shape = sized(FacetType::tri3);
  shape.value = area_coordinates(xi);
  shape.gradient = area_gradient();
  return shape;
}

ShapeFunctions tri6(const Vector2d& xi) {
  // Area coordinates L_i and their constant gradients are those of the linear triangle.
  const ShapeFunctions area = tri3(xi);
  ShapeFunctions shape = sized(FacetType::tri6);
  for (Index i = 0; i < 3; ++i) {
    const Index j = (i + 1) % 3;
    shape.value[i] = area.value[i] * (2 * area.value[i] - 1);
    shape.gradient.row(i) = (4 * area.value[i] - 1) * area.gradient.row(i);
    shape.value[3 + i] = 4 * area.value[i] * area.value[j];
    shape.gradient.row(3 + i) = 4 * (area.value[j] * area.gradient.row(i) + area.value[i] * area.gradient.row(j));
  }
  return shape;
}

/// Shape functions of tri6 at the centre of the triangle.
double tri6_at_centre(Index node) { return (node < 3 ? -1.0 : 4.0) / 9.0; }

ShapeFunctions tri7(const Vector2d& xi) {
  // The functions of tri6 minus their values at the centre times the bubble 27 L_0 L_1 L_2, which is 1 at the centre.
  const ShapeFunctions area = tri3(xi);
  const ShapeFunctions edges = tri6(xi);
  const FacetVector& L = area.value;
  const double bubble = 27 * L[0] * L[1] * L[2];
  const Eigen::RowVector2d bubble_gradient = 27 *
                                             (L[1] * L[2] * area.gradient.row(0) + L[2] * L[0] * area.gradient.row(1) +
                                              L[0] * L[1] * area.gradient.row(2));
  ShapeFunctions shape = sized(FacetType::tri7);
  for (Index a = 0; a < 6; ++a) {
    shape.value[a] = edges.value[a] - tri6_at_centre(a) * bubble;
    shape.gradient.row(a) = edges.gradient.row(a) - tri6_at_centre(a) * bubble_gradient;
  }
  shape.value[6] = bubble;
  shape.gradient.row(6) = bubble_gradient;
  return shape;
}

ShapeFunctions quad4(const Vector2d& xi) {
  ShapeFunctions shape = sized(FacetType::quad4);
  for (Index a = 0; a < 4; ++a) {
    const auto& [r, s] = at(corner_sign, a);
    shape.value[a] = 0.25 * (1 + r * xi[0]) * (1 + s * xi[1]);
    shape.gradient.row(a) << 0.25 * r * (1 + s * xi[1]), 0.25 * s * (1 + r * xi[0]);
  }
  return shape;
}

ShapeFunctions quad9(const Vector2d& xi) {
  ShapeFunctions shape = sized(FacetType::quad9);
  for (Index a = 0; a < 9; ++a) {
    const auto& grid = at(quad9_grid, a);
    const Value r = lagrange_quadratic(grid[0], xi[0]);
    const Value s = lagrange_quadratic(grid[1], xi[1]);
    shape.value[a] = r.value * s.value;
    shape.gradient.row(a) << r.derivative * s.value, r.value * s.derivative;
  }
  return shape;
}

ShapeFunctions quad8(const Vector2d& xi) {
  // The serendipity functions are those of quad9, with the function of the centre node distributed such that the sum
  // stays 1: -1/4 of it to each corner, 1/2 to each mid-edge node.
  const ShapeFunctions full = quad9(xi);
  ShapeFunctions shape = sized(FacetType::quad8);
  for (Index a = 0; a < 8; ++a) {
    const double share = a < 4 ? -0.25 : 0.5;
    shape.value[a] = full.value[a] + share * full.value[8];
    shape.gradient.row(a) = full.gradient.row(a) + share * full.gradient.row(8);
  }
  return shape;
}

/// Second derivatives of a product of two functions with constant gradients f and g.
Eigen::RowVector3d product_hessian(const Eigen::RowVector2d& f, const Eigen::RowVector2d& g) {
  return {2 * f[0] * g[0], 2 * f[1] * g[1], f[0] * g[1] + f[1] * g[0]};
}

FacetHessian tri6_hessian() {
  const FacetGradient area_gradient = tri3(Vector2d::Zero()).gradient;
  FacetHessian hessian(6, 3);
  for (Index i = 0; i < 3; ++i) {
    hessian.row(i) = 2 * product_hessian(area_gradient.row(i), area_gradient.row(i));
    hessian.row(3 + i) = 4 * product_hessian(area_gradient.row(i), area_gradient.row((i + 1) % 3));
  }
  return hessian;
}

FacetHessian tri7_hessian(const Vector2d& xi) {
  const Eigen::RowVector3d bubble = 27 * Eigen::RowVector3d(-2 * xi[1], -2 * xi[0], 1 - 2 * xi[0] - 2 * xi[1]);
  FacetHessian hessian(7, 3);
  hessian.topRows(6) = tri6_hessian();
  for (Index a = 0; a < 6; ++a) hessian.row(a) -= tri6_at_centre(a) * bubble;
  hessian.row(6) = bubble;
  return hessian;
}

FacetHessian quad4_hessian() {
  FacetHessian hessian = FacetHessian::Zero(4, 3);
  for (Index a = 0; a < 4; ++a) {
    const auto& [r, s] = at(corner_sign, a);
    hessian(a, 2) = 0.25 * r * s;
  }
  return hessian;
}

FacetHessian quad9_hessian(const Vector2d& xi) {
  FacetHessian hessian(9, 3);
  for (Index a = 0; a < 9; ++a) {
    const auto& grid = at(quad9_grid, a);
    const Value r = lagrange_quadratic(grid[0], xi[0]);
    const Value s = lagrange_quadratic(grid[1], xi[1]);
    hessian.row(a) << r.second * s.value, r.value * s.second, r.derivative * s.derivative;
  }
  return hessian;
}

FacetHessian quad8_hessian(const Vector2d& xi) {
  const FacetHessian full = quad9_hessian(xi);
  FacetHessian hessian = full.topRows(8);
  hessian.topRows(4).rowwise() -= 0.25 * full.row(8);
  hessian.bottomRows(4).rowwise() += 0.5 * full.row(8);
  return hessian;
}

}  // namespace

int node_count(FacetType type) {
  switch (type) {
    case FacetType::tri3:
      return 3;
    case FacetType::tri6:
      return 6;
    case FacetType::tri7:
      return 7;
    case FacetType::quad4:
      return 4;
    case FacetType::quad8:
      return 8;
    case FacetType::quad9:
      return 9;
  }
  throw std::logic_error("unknown facet type");
}

bool is_triangle(FacetType type) {
  return type == FacetType::tri3 || type == FacetType::tri6 || type == FacetType::tri7;
}

int corner_count(FacetType type) { return is_triangle(type) ? 3 : 4; }

bool is_flat(FacetType type) { return type == FacetType::tri3; }

int edge_degree(FacetType type) { return type == FacetType::tri3 || type == FacetType::quad4 ? 1 : 2; }

std::optional<FacetType> facet_type(bool triangle, int nodes) {
  for (const FacetType type : all_types) {
    if (is_triangle(type) == triangle && node_count(type) == nodes) return type;
  }
  return std::nullopt;
}

Vector2d parametric_centre(FacetType type) {
  return is_triangle(type) ? Vector2d(1.0 / 3.0, 1.0 / 3.0) : Vector2d(0, 0);
}

Vector2d parametric_node(FacetType type, int node) {
  constexpr std::array<std::array<double, 2>, 7> triangle{
      {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}, {1.0 / 3.0, 1.0 / 3.0}}};
  if (is_triangle(type)) return {at(triangle, node)[0], at(triangle, node)[1]};
  return {static_cast<double>(at(quad9_grid, node)[0]), static_cast<double>(at(quad9_grid, node)[1])};
}

const FacetGradient& gradient_at_node(FacetType type, int node) {
  static const std::vector<std::vector<FacetGradient>> of_types = [] {
    std::vector<std::vector<FacetGradient>> gradients;
    for (const FacetType each : all_types) {
      std::vector<FacetGradient>& own = gradients.emplace_back();
      for (int a = 0; a < node_count(each); ++a)
        own.push_back(shape_functions(each, parametric_node(each, a)).gradient);
    }
    return gradients;
  }();
  return at(at(of_types, static_cast<int>(type)), node);
}

double distance_outside(FacetType type, const Vector2d& xi) {
  if (is_triangle(type)) return std::max({0.0, -xi[0], -xi[1], xi[0] + xi[1] - 1});
  return std::max(0.0, xi.cwiseAbs().maxCoeff() - 1);
}

ShapeFunctions shape_functions(FacetType type, const Vector2d& xi) {
  switch (type) {
    case FacetType::tri3:
      return tri3(xi);
    case FacetType::tri6:
      return tri6(xi);
    case FacetType::tri7:
      return tri7(xi);
    case FacetType::quad4:
      return quad4(xi);
    case FacetType::quad8:
      return quad8(xi);
    case FacetType::quad9:
      return quad9(xi);
  }
  throw std::logic_error("unknown facet type");
}

FacetHessian shape_hessian(FacetType type, const Vector2d& xi) {
  switch (type) {
    case FacetType::tri3:
      return FacetHessian::Zero(3, 3);
    case FacetType::tri6:
      return tri6_hessian();
    case FacetType::tri7:
      return tri7_hessian(xi);
    case FacetType::quad4:
      return quad4_hessian();
    case FacetType::quad8:
      return quad8_hessian(xi);
    case FacetType::quad9:
      return quad9_hessian(xi);
  }
  throw std::logic_error("unknown facet type");
}

Index number_in(const Facet& facet, Index node) {
  return std::distance(facet.begin(), std::find(facet.begin(), facet.end(), node));
}

FacetCoordinates facet_coordinates(const Facet& facet, const Matrix3Xd& positions) {
  const int n = node_count(facet.type);
  FacetCoordinates coordinates(3, n);
  for (int a = 0; a < n; ++a) coordinates.col(a) = positions.col(facet.node(a));
  return coordinates;
}

FacetCoordinates facet_columns(const Facet& facet, const Matrix3Xd& vectors) {
  return vectors.size() > 0 ? facet_coordinates(facet, vectors) : FacetCoordinates(3, 0);
}

FacetVector facet_values(const Facet& facet, const NodalField& field) {
  const int n = node_count(facet.type);
  FacetVector values(n);
  for (int a = 0; a < n; ++a) values[a] = field[facet.node(a)];
  return values;
}

}  // namespace mixture_contact
