/// What the nodes of the surface that a pass does not integrate over face.
#pragma once

#include "interface/pass.h"

#include <optional>

namespace mixture_contact {

/// A pass over one of the two surfaces.
struct SidedPass {
  Side side;  ///< the surface integrated over
  std::unique_ptr<ContactPass> integral;
  std::optional<NodeFlags> faced;    ///< nodes of the other surface that face contact, during iterations
  IndexedVector<int> faced_changes;  ///< of these, since the iterations began
};

/// A node of the surface that a pass does not integrate over.
struct FacingNode {
  int facet = -1;  ///< of the surface integrated over; -1: none
  double gap = 0;  ///< along the node's own normal [mm]
  bool in_contact = false;
};

/// How far and how precisely nodes look.
struct Reach {
  double distance;   ///< [mm]
  double tolerance;  ///< outside a facet, in parametric coordinates [-]
};

/// As the settings say; where they leave the distance open, as far as the smaller surface is large.
Reach reach_of(const Settings& settings, const PerSide<Matrix3Xd>& position);

/// What the nodes of the other surface face, given which nodes of the surface integrated over are in contact.
IndexedVector<FacingNode> facing_nodes(const SidedPass& pass, const PerSide<SurfaceMesh>& mesh,
                                       const PerSide<Matrix3Xd>& position, const NodeFlags& in_contact,
                                       const Reach& reach);

NodeFlags in_contact_of(const IndexedVector<FacingNode>& nodes);

/// Which nodes an iteration that begins has facing contact, where `facing` do. Nodes that change too often are at the
/// edge of contact, as ActiveSet has it; here no load tells whether they are.
NodeFlags next_facing(const SidedPass& pass, NodeFlags facing);
/// Takes over which nodes face contact, for an iteration that has begun, and counts the changes.
void hold_facing(SidedPass& pass, const NodeFlags& facing);

/// Outward unit normals at the nodes: the sum of the area vectors of the facets around each.
Matrix3Xd nodal_normals(const SurfaceMesh& mesh, const Matrix3Xd& position);

}  // namespace mixture_contact
