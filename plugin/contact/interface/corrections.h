/// Functions of a contact for a host that keeps its matrix for several iterations.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// True if the next iteration can use the corrected linearisation of the last matrix (see HeldLinearisation::serves()).
/// If no pass can be corrected, true if the state is a solution.
bool serves_again(const ContactInterface& contact, const PerSide<SurfaceFields>& fields);

/// Begins an iteration with the corrected linearisation of the last one (see HeldLinearisation::correct()). Returns
/// true if loads change.
bool correct(ContactInterface& contact, const PerSide<SurfaceFields>& fields);

/// Adds the residual of the change of the loads at the start of the iteration (see
/// HeldLinearisation::residual_change()). Returns false if the change is unknown.
bool residual_change(const ContactInterface& contact, const PerSide<SurfaceFields>& fields, double dt,
                     const ContactInterface::AddResidual& add);

/// Notes that the host has assembled a matrix with the present linearisations. `has_loads`: per side, true if load
/// blocks are unknowns of the matrix, such that nodes can be released and added. `rigid`: nodes of rigid bodies, which
/// have no equations of their own and cannot be released or added.
void has_matrix(ContactInterface& contact, const PerSide<bool>& has_loads, const PerSide<NodeFlags>& rigid);

/// True if the status of nodes may be predicted with the matrix (see HeldLinearisation::may_decide()).
bool may_decide(const ContactInterface& contact);
/// Linearises open nodes that overlap after these displacements of the surfaces [mm] (see
/// HeldLinearisation::find_nearing()). Returns the newly linearised nodes.
PerSide<NodeFlags> find_nearing_nodes(ContactInterface& contact, const PerSide<Matrix3Xd>& displacements,
                                      const PerSide<SurfaceFields>& fields);
/// Open nodes that are linearised but not in the matrix (see HeldLinearisation::nearing()).
PerSide<NodeFlags> nearing_nodes(const ContactInterface& contact);
/// Calls `add` with the tangents of the loads that nearing_nodes() would have in contact.
void nearing_loads(const ContactInterface& contact, double dt, const ContactInterface::AddLoadTangent& add);
/// Tractions of the nodes whose status may be predicted with the matrix [MPa]; NaN at all other nodes (see
/// HeldLinearisation::undecided()).
PerSide<VectorXd> undecided_tractions(const ContactInterface& contact, const PerSide<SurfaceFields>& fields);
/// The nodes that open at the start of the iteration. `tractions`: of the nodes whose status is predicted, at the end
/// of the iteration [MPa]. `opened`: nodes that were assumed open for these tractions (see
/// HeldLinearisation::opening()).
PerSide<NodeFlags> opening_nodes(const ContactInterface& contact, const PerSide<VectorXd>& tractions,
                                 const PerSide<NodeFlags>& opened);
/// Begins an iteration with these nodes open, and the other nodes whose status is predicted closed (see
/// HeldLinearisation::open()).
void open_nodes(ContactInterface& contact, const PerSide<NodeFlags>& nodes, const PerSide<SurfaceFields>& fields);

/// A node whose load is in the matrix but which is open.
struct ReleasedNode {
  Side side;
  int node;
};
/// The released nodes of all passes.
std::vector<ReleasedNode> released_nodes(const ContactInterface& contact);

/// Calls `add` with the tangents of the loads of nodes in contact that are not in the matrix.
void added_loads(const ContactInterface& contact, double dt, const ContactInterface::AddLoadTangent& add);

}  // namespace mixture_contact
