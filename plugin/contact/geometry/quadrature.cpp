#include "geometry/quadrature.h"

#include "geometry/sub_facets.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
#include <stdexcept>
#include <string>

namespace mixture_contact {
namespace {

std::vector<QuadraturePoint> quadrilateral_rule(int order) {
  const Eigen::MatrixX2d line = gauss_legendre(order);
  std::vector<QuadraturePoint> rule;
  for (Index j = 0; j < order; ++j) {
    for (Index i = 0; i < order; ++i) rule.push_back({{line(i, 0), line(j, 0)}, line(i, 1) * line(j, 1)});
  }
  return rule;
}

/// The points of a symmetric triangle rule with area coordinates (1 - 2a, a, a) in all three rotations.
void add_orbit(std::vector<QuadraturePoint>& rule, double a, double weight) {
  rule.push_back({{a, a}, weight});
  rule.push_back({{1 - 2 * a, a}, weight});
  rule.push_back({{a, 1 - 2 * a}, weight});
}

/// Conical product: the square [-1, 1]^2 collapsed onto the triangle. Its Jacobian reduces the exact degree by one.
std::vector<QuadraturePoint> conical_rule(int order) {
  std::vector<QuadraturePoint> rule;
  for (const QuadraturePoint& square : quadrilateral_rule(order)) {
    const double r = 0.5 * (1 + square.xi[0]);
    const double s = 0.5 * (1 + square.xi[1]) * (1 - r);
    rule.push_back({{r, s}, 0.25 * square.weight * (1 - r)});
  }
  return rule;
}

std::vector<QuadraturePoint> triangle_rule(int order) {
  std::vector<QuadraturePoint> rule;
  if (order == 1) {
    rule.push_back({{1.0 / 3.0, 1.0 / 3.0}, 0.5});
  } else if (order == 2) {
    add_orbit(rule, 1.0 / 6.0, 1.0 / 6.0);
  } else if (order == 3) {
    const double root = std::sqrt(15.0);
    rule.push_back({{1.0 / 3.0, 1.0 / 3.0}, 9.0 / 80.0});
    add_orbit(rule, (6 - root) / 21, (155 - root) / 2400);
    add_orbit(rule, (6 + root) / 21, (155 + root) / 2400);
  } else {
    rule = conical_rule(order);
  }
  return rule;
}

}  // namespace

Eigen::MatrixX2d gauss_legendre(int points) {
  // Eigenvalues of the symmetric Jacobi matrix of the Legendre recurrence are the abscissae; the squared first
  // components of the eigenvectors times the length 2 of the interval are the weights.
  MatrixXd jacobi = MatrixXd::Zero(points, points);
  for (int k = 1; k < points; ++k) jacobi(k, k - 1) = jacobi(k - 1, k) = k / std::sqrt(4.0 * k * k - 1.0);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(jacobi);
  Eigen::MatrixX2d rule(points, 2);
  rule.col(0) = eigen.eigenvalues();
  rule.col(1) = 2 * eigen.eigenvectors().row(0).transpose().cwiseAbs2();
  return rule;
}

std::vector<QuadraturePoint> quadrature(FacetType type, int order) {
  if (order < 1 || order > max_quadrature_order) {
    throw std::invalid_argument("integration order " + std::to_string(order) + " is not between 1 and " +
                                std::to_string(max_quadrature_order));
  }
  return is_triangle(type) ? triangle_rule(order) : quadrilateral_rule(order);
}

std::vector<QuadraturePoint> piecewise_quadrature(FacetType type, int order) {
  std::vector<QuadraturePoint> rule;
  for (const SubFacet& piece : sub_facets(type)) {
    Eigen::Matrix2Xd corners(2, node_count(piece.type));
    for (Index a = 0; a < corners.cols(); ++a) {
      corners.col(a) = parametric_node(type, at(piece.nodes, a));
    }
    for (const QuadraturePoint& q : quadrature(piece.type, order)) {
      const ShapeFunctions shape = shape_functions(piece.type, q.xi);
      const Eigen::Matrix2d slope = corners * shape.gradient;
      rule.push_back({corners * shape.value, q.weight * std::abs(slope.determinant())});
    }
  }
  return rule;
}

int default_quadrature_order(FacetType type) { return edge_degree(type) + 1; }

}  // namespace mixture_contact
