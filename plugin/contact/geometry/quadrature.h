/// Gauss rules on facets.
#pragma once

#include "geometry/facet.h"

#include <vector>

namespace mixture_contact {

/// A point of a quadrature rule: parametric coordinates and weight (the weights add up to the domain's area, 4 or 1/2).
struct QuadraturePoint {
  Vector2d xi;
  double weight;
};

/// Gauss-Legendre rule on [-1, 1] with n points, exact to degree 2n - 1 (Golub and Welsch 1969).
/// Columns: abscissa, weight; shape (n, 2).
Eigen::MatrixX2d gauss_legendre(int points);

/// Quadrature rule of a facet.
///
/// Quadrilaterals: order x order tensor Gauss rule, exact to degree 2 order - 1 in each coordinate. Triangles: the
/// symmetric rules with 1 (degree 1), 3 (degree 2) and 7 points (degree 5, Radon 1948) for order 1, 2, 3, and the
/// conical product of Gauss rules, exact to total degree 2 order - 2, beyond. Throws std::invalid_argument unless 1 <=
/// order <= max_quadrature_order.
std::vector<QuadraturePoint> quadrature(FacetType type, int order);

/// Quadrature rule of a facet that applies quadrature() to each linear piece of it, for functions that are polynomials
/// on the pieces. Points and weights are in parametric coordinates of the facet.
std::vector<QuadraturePoint> piecewise_quadrature(FacetType type, int order);

inline constexpr int max_quadrature_order = 10;

/// The order used where the user gives none: 2 for linear facets, 3 for quadratic ones.
int default_quadrature_order(FacetType type);

}  // namespace mixture_contact
