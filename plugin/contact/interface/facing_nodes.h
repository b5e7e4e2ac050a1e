/// The points opposite the nodes of a pass's other surface.
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
  bool has_reconsidered = false;     ///< since then, too
};

/// The point opposite a node of a pass's other surface.
struct FacingNode {
  int facet = -1;  ///< of the surface integrated over; -1: none
  double gap = 0;  ///< along the node's own normal [mm]
  bool in_contact = false;
};

/// The search radius of the settings. Its default behind the facet, for overlapping bodies, is half the size of the
/// smaller surface, because bodies hide the surfaces behind them. Ahead it is a quarter of a facet, and more for tilted
/// facets; with tension and self-contact, it is that behind. Surfaces that meet within a step find each other once they
/// overlap.
Reach reach_of(const Settings& settings, const FacingPositions& x);

/// The point that each node of a surface, the primary one of the positions, meets on the other one along its normal,
/// within reach and not hidden from it.
IndexedVector<std::optional<SurfaceHit>> hits_of_nodes(const SurfaceMesh& own, const SurfaceMesh& other,
                                                       const FacingPositions& x, const Settings& settings);

/// The points that nodes of the other surface face, given which nodes of the surface integrated over are in contact.
IndexedVector<FacingNode> facing_nodes(const SidedPass& pass, const PerSide<SurfaceMesh>& mesh,
                                       const PerSide<Matrix3Xd>& position, const NodeFlags& in_contact,
                                       const Settings& settings);

NodeFlags in_contact_of(const IndexedVector<FacingNode>& nodes);

/// Nodes that face contact in an iteration that begins, where `facing` do. Nodes that change too often are at the edge
/// of contact, as in ActiveSet; loads play no part here.
NodeFlags next_facing(const SidedPass& pass, NodeFlags facing);
/// Takes over which nodes face contact, for an iteration that has begun, and counts the changes.
void hold_facing(SidedPass& pass, const NodeFlags& facing);

/// Whether nodes held after too many changes should have another status by `facing` at a solution. They are tried once
/// more. Resets all counts, at most once after the start of iterations.
bool reconsiders_facing(SidedPass& pass, const NodeFlags& facing);

/// Outward unit normals at the nodes: the sum of the area vectors of the facets around each.
Matrix3Xd nodal_normals(const SurfaceMesh& mesh, const Matrix3Xd& position);

}  // namespace mixture_contact
