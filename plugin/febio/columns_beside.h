/// Which couplings of a contact stand beside the matrix.
///
/// The change of the geometry couples nodes across the contact, which costs the matrix much of its fill and an
/// iteration little if it is left out: it is small beside the stiffness of the bodies (docs/explanation/matrix.md).
#pragma once

#include "node_equations.h"

/// Of the columns of a node's rows, given with their equations, those nodes that stand beside the matrix: of the other
/// surface, with equations of their own, free ones.
mixture_contact::NodeFlags columns_beside(const NodeEquations& equations, const NodeEquations::Location& row,
                                          const NodeEquations::Location& columns, const std::vector<int>& ids);

/// A patch without these nodes.
mixture_contact::Patch without(const mixture_contact::Patch& patch, const mixture_contact::NodeFlags& nodes);
