/// The requests of a host that keeps its matrix for several iterations.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// Whether the next iteration can use the corrected linearisation of the last matrix (see HeldLinearisation::serves());
/// if none can be corrected, whether the state is a solution.
bool serves_again(const ContactInterface& contact, const PerSide<SurfaceFields>& fields);

/// Begins an iteration with the linearisation of the last one (see HeldLinearisation::correct()). Returns whether loads
/// change.
bool correct(ContactInterface& contact, const PerSide<SurfaceFields>& fields);

/// Adds the residual of the change of the loads at the start of the iteration (see
/// HeldLinearisation::residual_change()). Returns whether it is known.
bool residual_change(const ContactInterface& contact, const PerSide<SurfaceFields>& fields, double dt,
                     const ContactInterface::AddResidual& add);

/// A matrix has been formed of the present linearisations. `has_loads`: on which sides loads that come as load blocks
/// are unknowns of it, so that nodes can be released, and others added; not with `rigid` nodes, which have no
/// equations of their own.
void has_matrix(ContactInterface& contact, const PerSide<bool>& has_loads, const PerSide<NodeFlags>& rigid);

/// Whether the matrix may change the status of nodes as the iteration begins (see HeldLinearisation::may_decide()).
bool may_decide(const ContactInterface& contact);
/// Linearises nodes out of contact that overlap once the surfaces have moved by these displacements [mm] (see
/// HeldLinearisation::find_nearing()). Returns those that were not linearised.
PerSide<NodeFlags> find_nearing_nodes(ContactInterface& contact, const PerSide<Matrix3Xd>& displacements,
                                      const PerSide<SurfaceFields>& fields);
/// Open nodes that are linearised but not in the matrix (see HeldLinearisation::nearing()).
PerSide<NodeFlags> nearing_nodes(const ContactInterface& contact);
/// Calls `add` with the tangents of the loads of nearing_nodes(), should these close.
void nearing_loads(const ContactInterface& contact, double dt, const ContactInterface::AddLoadTangent& add);
/// Tractions of nodes whose status the matrix may change as the iteration begins [MPa]; NaN at all others (see
/// HeldLinearisation::undecided()).
PerSide<VectorXd> undecided_tractions(const ContactInterface& contact, const PerSide<SurfaceFields>& fields);
/// Nodes that open as the iteration begins, given the tractions at its end of the nodes that are predicted [MPa];
/// `opened`: nodes that were taken to be open in finding these tractions (see HeldLinearisation::opening()).
PerSide<NodeFlags> opening_nodes(const ContactInterface& contact, const PerSide<VectorXd>& tractions,
                                 const PerSide<NodeFlags>& opened);
/// Begins an iteration with these nodes open, of those whose status is predicted (see HeldLinearisation::open()).
void open_nodes(ContactInterface& contact, const PerSide<NodeFlags>& nodes, const PerSide<SurfaceFields>& fields);

/// A node whose load is in the matrix and not in the status.
struct ReleasedNode {
  Side side;
  int node;
};
std::vector<ReleasedNode> released_nodes(const ContactInterface& contact);

/// Calls `add` with the tangents of loads of the status that the matrix lacks.
void added_loads(const ContactInterface& contact, double dt, const ContactInterface::AddLoadTangent& add);

}  // namespace mixture_contact
