/// Deferred coupling terms: the couplings of a contact that FEBio's matrix leaves out.
///
/// The change of the geometry couples nodes across the contact and adds many entries to the factors. Iterations lose
/// little without it, because it is small compared with the stiffness of the bodies
/// (docs/development/solver-devices.md).
#pragma once

#include "node_equations.h"

/// Whether the n-th node among the columns of a node's rows, given with their equations, has equations of its own, none
/// of a prescribed value, as the row's node has: FEBio's assembly has nothing to do with it.
bool is_free(const NodeEquations& equations, const NodeEquations::Location& row, const NodeEquations::Location& columns,
             const std::vector<int>& ids, mixture_contact::Index n);

/// Nodes among the columns of a node's rows, given with their equations, whose coupling terms are deferred: the free
/// ones of the other surface.
mixture_contact::NodeFlags columns_beside(const NodeEquations& equations, const NodeEquations::Location& row,
                                          const NodeEquations::Location& columns, const std::vector<int>& ids);

/// A patch without these nodes.
mixture_contact::Patch without(const mixture_contact::Patch& patch, const mixture_contact::NodeFlags& nodes);
