/// Quadrature rules on facets.
#pragma once

#include "geometry/facet.h"

#include <vector>

namespace mixture_contact {

/// A point of a quadrature rule. The weights of a rule add up to the area of the parametric domain: 4 for
/// quadrilaterals, 1/2 for triangles.
struct QuadraturePoint {
  Vector2d xi;
  double weight;
};

/// Gauss-Legendre rule on [-1, 1] with this number of points n, exact to degree 2n - 1 (Golub and Welsch 1969). Returns
/// abscissas and weights in the columns, shape (n, 2).
Eigen::MatrixX2d gauss_legendre(int points);

/// Quadrature rule of a facet type.
std::vector<QuadraturePoint> quadrature(FacetType type, int order);

/// Rule of a facet that applies quadrature() to each of its linear pieces (sub_facets()), for functions that are
/// polynomials on the pieces. Points and weights are in parametric coordinates of the facet.
std::vector<QuadraturePoint> piecewise_quadrature(FacetType type, int order);

/// Highest order that quadrature() accepts.
inline constexpr int max_quadrature_order = 10;

/// Order of the rule if the user gives none: 2 for linear facets, 3 for quadratic ones.
int default_quadrature_order(FacetType type);

}  // namespace mixture_contact
