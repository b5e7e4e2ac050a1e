/// Deferred coupling terms: the couplings of a contact that are not in FEBio's matrix.
///
/// The geometric part of the tangent couples nodes across the contact and adds many entries to the factors. Iterations
/// converge almost as fast without it, because it is small compared with the stiffness of the bodies
/// (docs/development/solver-devices.md).
#pragma once

#include "node_equations.h"

/// True if the n-th node of the columns, like the row's node, has equations of its own and none with a prescribed
/// value. FEBio's own assembly then has no further effect on these entries. `ids`: equations of the columns.
bool is_free(const NodeEquations& equations, const NodeEquations::Location& row, const NodeEquations::Location& columns,
             const std::vector<int>& ids, mixture_contact::Index n);

/// The nodes of the columns whose coupling terms with the row's node are deferred: free nodes of the other surface.
/// `ids`: equations of the columns.
mixture_contact::NodeFlags columns_beside(const NodeEquations& equations, const NodeEquations::Location& row,
                                          const NodeEquations::Location& columns, const std::vector<int>& ids);

/// The patch without the flagged nodes.
mixture_contact::Patch without(const mixture_contact::Patch& patch, const mixture_contact::NodeFlags& nodes);
