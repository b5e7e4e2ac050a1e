/// The geometric part of the tangent by nodes: the sum over the pairs of facets around a node. Much of it
/// cancels: a facet that is cut otherwise carries the same load, so that the forces at its nodes do not depend on those
/// it faces.
#pragma once

#include "enforcement/virtual_work.h"

namespace mixture_contact {

/// A coupling of two nodes across the contact is weak if its entries are at most this part of the largest of their row.
/// Entries that cancel leave such a part, if the rule on the pieces is exact.
inline constexpr double weak_coupling = 1e-5;

/// Blocks of one effect, each with the rows of one node, by the displacements of the nodes that they depend on.
using NodeRows = IndexedVector<TangentBlock>;

/// The rows of tractions without weak couplings, given the numbers of nodes of the surfaces. `held`: rows that are
/// known, of nodes whose pairs are as they were.
NodeRows traction_rows(const GeometricParts& pairs, PerSide<Index> nodes, double weak = weak_coupling,
                       NodeRows held = {});

/// The rows of the flux of a field, in a time increment of 1.
NodeRows flux_rows(const GeometricParts& pairs, PerSide<Index> nodes, int field, double weak = weak_coupling,
                   NodeRows held = {});

}  // namespace mixture_contact
