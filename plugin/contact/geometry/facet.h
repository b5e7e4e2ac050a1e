/// The facets of a contact surface: types, shape functions and parametric domains.
#pragma once

#include "base/indexed_vector.h"

#include <array>
#include <optional>
#include <vector>

namespace mixture_contact {

/// Facet types, with FEBio's node order: corners counter-clockwise seen from outside, then mid-edges, then the centre.
/// Triangles live on xi >= 0, eta >= 0, xi + eta <= 1; quadrilaterals on [-1, 1]^2.
enum class FacetType { tri3, tri6, tri7, quad4, quad8, quad9 };

/// Number of nodes of a facet type.
int node_count(FacetType type);

/// True for triangles, false for quadrilaterals.
bool is_triangle(FacetType type);

/// Number of corners of a facet, which are the first nodes of every type.
int corner_count(FacetType type);

/// True if a facet of this type is flat for all positions of its nodes, because its shape functions have constant
/// gradients (tri3).
bool is_flat(FacetType type);

/// Polynomial degree along an edge: 1 or 2.
int edge_degree(FacetType type);

/// The facet type with this many nodes on a triangle or a quadrilateral; empty if there is none.
std::optional<FacetType> facet_type(bool triangle, int nodes);

/// Parametric coordinates of the centre of a facet.
Vector2d parametric_centre(FacetType type);

/// Parametric coordinates of each node, in node order.
Vector2d parametric_node(FacetType type, int node);

/// Distance in parametric coordinates by which a point lies outside the facet's domain; 0 inside.
double distance_outside(FacetType type, const Vector2d& xi);

/// Shape functions N_a(xi) and their derivatives with respect to xi.
struct ShapeFunctions {
  FacetVector value;       ///< shape functions N_a, shape (n)
  FacetGradient gradient;  ///< derivatives dN_a/dxi_alpha, shape (n, 2)
};

/// Shape functions of a facet type at parametric coordinates xi, which may be outside of the facet.
ShapeFunctions shape_functions(FacetType type, const Vector2d& xi);

/// Shape functions of a tri3 at xi: its area coordinates [-].
inline Vector3d area_coordinates(const Vector2d& xi) { return {1 - xi[0] - xi[1], xi[0], xi[1]}; }
/// Derivatives of a tri3's area coordinates with respect to xi, shape (3, 2).
inline Eigen::Matrix<double, 3, 2> area_gradient() {
  return (Eigen::Matrix<double, 3, 2>() << -1, -1, 1, 0, 0, 1).finished();
}

/// The derivatives dN_a/dxi_alpha at a node of the facet, shape (n, 2).
const FacetGradient& gradient_at_node(FacetType type, int node);

/// Second derivatives of the shape functions with respect to xi: columns N_a,11, N_a,22, N_a,12, shape (n, 3).
FacetHessian shape_hessian(FacetType type, const Vector2d& xi);

/// A facet: its type and the indices of its nodes on the surface, of which the first node_count(type) entries are
/// valid.
struct Facet {
  FacetType type = FacetType::quad4;
  std::array<int, max_facet_nodes> nodes{};

  int count() const { return node_count(type); }
  /// The surface index of the facet's a-th node.
  int node(Index a) const { return nodes[static_cast<std::size_t>(a)]; }
  /// Iterators over the facet's nodes.
  const int* begin() const { return nodes.data(); }
  const int* end() const { return nodes.data() + count(); }
};

/// The position of a surface node in a facet's node order; facet.count() if the node does not belong to the facet.
Index number_in(const Facet& facet, Index node);

/// The columns of a per-node array for the nodes of a facet, shape (3, n).
FacetCoordinates facet_coordinates(const Facet& facet, const Matrix3Xd& positions);

/// facet_coordinates(), or no columns if the array is empty.
FacetCoordinates facet_columns(const Facet& facet, const Matrix3Xd& vectors);

/// A scalar field with one value per node: a view of a vector, or of a column or row of a matrix.
using NodalField = Eigen::Ref<const VectorXd, 0, Eigen::InnerStride<>>;

/// The entries of a scalar field for the nodes of a facet, shape (n).
FacetVector facet_values(const Facet& facet, const NodalField& field);

}  // namespace mixture_contact
