/// The geometric part of the tangent by nodes: the sum of what the pairs of facets around a node have. Much of it
/// cancels there between a node and those that its facets face, since a facet that is cut otherwise carries the same
/// load.
#pragma once

#include "enforcement/virtual_work.h"

namespace mixture_contact {

/// A coupling of two nodes across the contact is weak where its entries are this part of the stiffness of the bodies
/// around them, at most. An iteration without it leaves about that part of the error of the one before.
inline constexpr double weak_coupling = 0.02;

/// Blocks of one effect, each with the rows of one node, by the displacements of the nodes that it is coupled with.
using NodeRows = IndexedVector<TangentBlock>;

/// The rows of tractions, given pairs that were found at x. A node is coupled with those that are coupled with it.
///
/// Nodes of one surface are coupled where they share a facet that carries load; of different surfaces where one of
/// their entries either way exceeds `weak` times the stiffness of the softer body there, or is the largest that a node
/// has on the other surface. The rest of a row acts at that node, so that bodies which are displaced as a whole have
/// the same forces with and without it. Rigid bodies keep all couplings.
NodeRows traction_rows(const FacingPairs& facing, const GeometricParts& pairs, const FacingPositions& x, double weak);

/// The rows of the flux of a field in a time increment of 1, with all couplings.
NodeRows flux_rows(const FacingPairs& facing, const GeometricParts& pairs, const FacingPositions& x, int field);

}  // namespace mixture_contact
