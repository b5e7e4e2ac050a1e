/// The facets of a contact surface: types, shape functions and parametric domains.
#pragma once

#include "types.h"

#include <array>
#include <optional>

namespace mixture_contact {

/// Facet types, with FEBio's node order: corners counter-clockwise seen from outside, then mid-edges, then the centre.
/// Triangles live on xi >= 0, eta >= 0, xi + eta <= 1; quadrilaterals on [-1, 1]^2.
enum class FacetType { tri3, tri6, tri7, quad4, quad8, quad9 };

/// Number of nodes of a facet type.
int node_count(FacetType type);

/// Whether the facet is a triangle (else a quadrilateral).
bool is_triangle(FacetType type);

/// Polynomial degree along an edge: 1 or 2.
int edge_degree(FacetType type);

/// The facet type with this many nodes on a triangle or a quadrilateral; empty if there is none.
std::optional<FacetType> facet_type(bool triangle, int nodes);

/// Parametric coordinates of the middle of a facet.
Vector2d parametric_centre(FacetType type);

/// Parametric coordinates of each node, in node order.
Vector2d parametric_node(FacetType type, int node);

/// Distance in parametric coordinates by which a point lies outside the facet's domain; 0 inside.
double distance_outside(FacetType type, const Vector2d& xi);

/// Shape functions N_a(xi) and their derivatives with xi.
struct ShapeFunctions {
  FacetVector value;       ///< N_a, shape (n)
  FacetGradient gradient;  ///< dN_a/dxi_alpha, shape (n, 2)
};

/// Shape functions of a facet type at parametric coordinates xi (anywhere in the plane).
ShapeFunctions shape_functions(FacetType type, const Vector2d& xi);

/// Second derivatives of the shape functions with xi: columns N_a,11, N_a,22, N_a,12, shape (n, 3).
FacetHessian shape_hessian(FacetType type, const Vector2d& xi);

/// Shape functions psi_a of tractions, fluxes and multipliers, and the weights of nodal averages, from the values N_a
/// of the ordinary ones: they span the same space, add up to 1, and have a positive integral each, which those of the
/// corners of serendipity quadrilaterals and quadratic triangles have not: psi_corner = N_corner + alpha sum of the
/// adjacent N_mid, psi_mid = (1 - 2 alpha) N_mid with alpha = 1/5 (Popp et al. 2012, SIAM J Sci Comput 34(4), B421).
/// Shape (n).
FacetVector multiplier_shape(FacetType type, const FacetVector& shape);

/// Their derivatives with xi, from those of the ordinary shape functions; shape (n, 2).
FacetGradient multiplier_gradient(FacetType type, const FacetGradient& gradient);

/// A facet: its type and the surface-local indices of its nodes (the first node_count(type) entries count).
struct Facet {
  FacetType type = FacetType::quad4;
  std::array<int, max_facet_nodes> nodes{};
};

/// Columns of a per-node array that belong to a facet's nodes, shape (3, n).
FacetCoordinates facet_coordinates(const Facet& facet, const Matrix3Xd& positions);

/// A scalar field, one value per node: a vector, or a column or row of a matrix, seen in place.
using NodalField = Eigen::Ref<const VectorXd, 0, Eigen::InnerStride<>>;

/// Entries of a per-node scalar field that belong to a facet's nodes, shape (n).
FacetVector facet_values(const Facet& facet, const NodalField& field);

}  // namespace mixture_contact
