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

/// Whether the facet is a triangle (else a quadrilateral).
bool is_triangle(FacetType type);

/// Number of corners of a facet, which are the first nodes of every type.
int corner_count(FacetType type);

/// Whether a facet is flat wherever its nodes are: its shape functions have the same slopes everywhere.
bool is_flat(FacetType type);

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

/// Shape functions of a tri3 at xi: its area coordinates [-].
inline Vector3d area_coordinates(const Vector2d& xi) { return {1 - xi[0] - xi[1], xi[0], xi[1]}; }
/// Derivatives of a tri3's area coordinates with xi, shape (3, 2).
inline Eigen::Matrix<double, 3, 2> area_gradient() {
  return (Eigen::Matrix<double, 3, 2>() << -1, -1, 1, 0, 0, 1).finished();
}

/// dN_a/dxi_alpha at a node of the facet, shape (n, 2).
const FacetGradient& gradient_at_node(FacetType type, int node);

/// Second derivatives of the shape functions with xi: columns N_a,11, N_a,22, N_a,12, shape (n, 3).
FacetHessian shape_hessian(FacetType type, const Vector2d& xi);

/// A linear piece of a facet: a triangle or quadrilateral between some of its nodes, by their numbers in node order;
/// the middle of an 8-node quadrilateral counts as node 8.
struct SubFacet {
  FacetType type;  ///< tri3 or quad4
  std::vector<int> nodes;
};

/// The linear pieces between neighbouring nodes that a facet is made of: a linear facet itself; four quadrilaterals;
/// four triangles, or six around the middle node. They are parallelograms or triangles in parametric coordinates.
const std::vector<SubFacet>& sub_facets(FacetType type);

/// The nodes around a facet in the order of its corners, with mid-edge nodes between these.
const std::vector<int>& outline(FacetType type);

/// The sub-facet at or nearest to a point, as its number in sub_facets().
int sub_facet_at(FacetType type, const Vector2d& xi);

/// Shape functions psi_a of tractions, fluxes and multipliers, and the weights of nodal averages: linear on each
/// sub-facet (bilinear on quadrilaterals), 1 at their own node and 0 at the others; the value at the middle of an
/// 8-node quadrilateral is the mean of its mid-edge nodes. They add up to 1 and are nowhere negative on the facet,
/// unlike the shape functions of quadratic facets. Every part of a facet therefore has positive weights (Puso, Laursen
/// and Solberg 2008, Comput Methods Appl Mech Eng 197:555-566). `sub_facet`: that of the point, whose functions
/// continue beyond it.
ShapeFunctions multiplier_functions(FacetType type, int sub_facet, const Vector2d& xi);

/// The parts in which the nodes that count take the function of a node that does not, shape (n): its neighbours that do
/// in equal parts, or where there are none all that do; a node that counts takes its own. `counts`: 1 for nodes that
/// count, 0 for the others, shape (n).
FacetVector heirs_of(FacetType type, int node, const FacetVector& counts);

/// Functions psi_a redistributed among the nodes of their facet that count, at least one: each of the others gives its
/// own, in equal parts, to its neighbours that count, or if there are none to all that do. They add up to 1, and are
/// nowhere negative if the given ones are not. `counts`: 1 for nodes that count, 0 for the others, shape (n).
ShapeFunctions redistributed(FacetType type, const ShapeFunctions& psi, const FacetVector& counts);

/// A facet: its type and the surface-local indices of its nodes (the first node_count(type) entries count).
struct Facet {
  FacetType type = FacetType::quad4;
  std::array<int, max_facet_nodes> nodes{};

  int count() const { return node_count(type); }
  int node(Index a) const { return nodes[static_cast<std::size_t>(a)]; }
  /// The first node_count(type) nodes.
  const int* begin() const { return nodes.data(); }
  const int* end() const { return nodes.data() + count(); }
};

/// The number of a surface's node among the nodes of a facet, in node order; facet.count() if the facet does not
/// contain it.
Index number_in(const Facet& facet, Index node);

/// Columns of a per-node array that belong to a facet's nodes, shape (3, n).
FacetCoordinates facet_coordinates(const Facet& facet, const Matrix3Xd& positions);

/// A scalar field, one value per node: a vector, or a column or row of a matrix, seen in place.
using NodalField = Eigen::Ref<const VectorXd, 0, Eigen::InnerStride<>>;

/// Entries of a per-node scalar field that belong to a facet's nodes, shape (n).
FacetVector facet_values(const Facet& facet, const NodalField& field);

}  // namespace mixture_contact
