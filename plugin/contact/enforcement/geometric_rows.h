/// The geometric part of the tangent by nodes: the sum over the pairs of facets around a node. Many terms cancel in the
/// sum. If a facet is divided differently into pieces, it carries the same load, so that the forces at its nodes do not
/// depend on the nodes of the facets that it faces.
#pragma once

#include "enforcement/virtual_work.h"

namespace mixture_contact {

/// The coupling of two nodes across the contact is weak if its entries are at most this fraction of the largest entry
/// of their row. If the quadrature is exact, terms that cancel leave entries of this size.
inline constexpr double weak_coupling = 1e-5;

/// Blocks of one effect, each with the rows of one node; columns are the displacements of the nodes on which they
/// depend.
using NodeRows = IndexedVector<TangentBlock>;

/// The rows of the tractions without weak couplings. `pairs`: geometric tangents by pairs. `nodes`: number of nodes of
/// each surface. `held`: known rows of nodes whose pairs have not changed.
NodeRows traction_rows(const GeometricParts& pairs, PerSide<Index> nodes, double weak = weak_coupling,
                       NodeRows held = {});

/// The rows of a field's flux without weak couplings, for a time increment of 1; arguments as in traction_rows().
NodeRows flux_rows(const GeometricParts& pairs, PerSide<Index> nodes, int field, double weak = weak_coupling,
                   NodeRows held = {});

}  // namespace mixture_contact
