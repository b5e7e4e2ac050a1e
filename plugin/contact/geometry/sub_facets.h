/// The linear pieces of facets, and the functions psi_a that are linear on them.
#pragma once

#include "geometry/facet.h"

namespace mixture_contact {

/// A linear piece of a facet: a triangle or a quadrilateral between some of its nodes. The nodes are given by their
/// numbers in node order; the centre of an 8-node quadrilateral counts as node 8.
struct SubFacet {
  FacetType type;  ///< tri3 or quad4
  std::vector<int> nodes;
};

/// The linear pieces of a facet, which are parallelograms or triangles in parametric coordinates: a linear facet
/// itself; four quadrilaterals for quad8 and quad9; four triangles for tri6, or six around the centre node for tri7.
const std::vector<SubFacet>& sub_facets(FacetType type);

/// The nodes on the boundary of a facet, in the order of its corners, with the mid-edge nodes in between.
const std::vector<int>& outline(FacetType type);

/// Number in sub_facets() of the linear piece that contains a point, or that is nearest to it.
int sub_facet_at(FacetType type, const Vector2d& xi);

/// The functions psi_a that interpolate tractions, fluxes and multipliers, and that weight nodal averages. They are
/// linear on each triangular piece and bilinear on each quadrilateral piece of a facet; psi_a is 1 at node a and 0 at
/// the other nodes. Their values at the centre of an 8-node quadrilateral are the means of those at the mid-edge nodes.
///
/// The functions add up to 1 and, unlike the shape functions of quadratic facets, are not negative anywhere on the
/// facet. Every part of a facet therefore has positive weights (Puso, Laursen and Solberg 2008, Comput Methods Appl
/// Mech Eng 197:555-566). `sub_facet`: number of the piece that contains the point; its functions also extend beyond
/// the piece.
ShapeFunctions multiplier_functions(FacetType type, int sub_facet, const Vector2d& xi);

/// Redistribution weights of a node: the fractions of its function psi that the nodes of the facet receive, shape (n).
/// A node that counts keeps its own function. The function of any other node goes in equal parts to those of its
/// neighbours that count, or to all nodes that count if no neighbour does. `counts`: 1 for nodes that count, 0 for the
/// others, shape (n).
FacetVector heirs_of(FacetType type, int node, const FacetVector& counts);

/// The functions psi_a redistributed to the nodes of their facet that count, of which there is at least one (weights:
/// heirs_of()). The result adds up to 1, and is not negative if the given functions are not. `counts`: 1 for nodes that
/// count, 0 for the others, shape (n).
ShapeFunctions redistributed(FacetType type, const ShapeFunctions& psi, const FacetVector& counts);

}  // namespace mixture_contact
