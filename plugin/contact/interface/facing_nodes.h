/// The points that nodes of the secondary surface of a pass face on its primary surface.
#pragma once

#include "interface/pass.h"

#include <optional>

namespace mixture_contact {

/// A pass with its side, and the status of the nodes of the other surface.
struct SidedPass {
  Side side = Side::primary;  ///< side of the surface over which the pass integrates
  std::unique_ptr<ContactPass> integral;
  /// Nodes of the other surface that face contact, during iterations; empty outside of them.
  std::optional<NodeFlags> faced;
  /// Nodes of the other surface that faced contact at the end of the last step; empty before the first one.
  NodeFlags faced_before;
  IndexedVector<int> faced_changes;  ///< number of changes in `faced` since the start of iterations, per node
  bool has_reconsidered = false;     ///< true if reconsiders_facing() has been true since the start of iterations
  Reach reach = 0;                   ///< search distances of the last search
  /// The points that the nodes of the other surface face at the present positions, if facing_nodes() has searched for
  /// them.
  mutable std::optional<IndexedVector<std::optional<SurfaceHit>>> hits;
};

/// The point that a node of the secondary surface of a pass faces.
struct FacingNode {
  int facet = -1;    ///< facet of the primary surface; -1: none
  double gap = 0;    ///< gap along the node's own normal [mm]
  double share = 0;  ///< contact status at the point, from the nodes of the facet: between 0 (open) and 1 (in contact)
};

/// The search distances of the settings. By default, the distance backwards (for overlapping bodies) is half the size
/// of the smaller surface, because bodies hide the surfaces behind them. The distance ahead is a quarter of a facet,
/// and larger for tilted facets; with tension and for self-contact it equals the distance backwards. Surfaces that meet
/// within a step find each other as soon as they overlap.
Reach reach_of(const Settings& settings, const FacingPositions& x);

/// The points that the nodes of the primary surface in `x` face on the secondary one along their normals, within reach
/// and not hidden; empty for nodes that face nothing. `tolerance`: see SearchRule.
IndexedVector<std::optional<SurfaceHit>> hits_of_nodes(const SurfaceMesh& own, const SurfaceMesh& other,
                                                       const FacingPositions& x, const Reach& reach, double tolerance);
/// The points within reach_of(), with the tolerance of the settings.
IndexedVector<std::optional<SurfaceHit>> hits_of_nodes(const SurfaceMesh& own, const SurfaceMesh& other,
                                                       const FacingPositions& x, const Settings& settings);

/// The points that nodes of the other surface face. `in_contact`: nodes in contact of the surface over which the pass
/// integrates. It searches only if the pass has no hits for the present positions.
IndexedVector<FacingNode> facing_nodes(const SidedPass& pass, const PerSide<SurfaceMesh>& mesh,
                                       const PerSide<Matrix3Xd>& position, const NodeFlags& in_contact,
                                       const Settings& settings);

/// The nodes that face contact: their share reaches ActiveSetOptions::contact_share.
NodeFlags facing_contact(const SidedPass& pass, const IndexedVector<FacingNode>& nodes);
/// The nodes that face contact in a step. A node that faced contact at the end of the last step, or did not, changes
/// only by ActiveSetOptions::contact_share_margin.
NodeFlags facing_contact_in_step(const SidedPass& pass, const IndexedVector<FacingNode>& nodes);

/// The nodes that face contact in the next iteration. `facing`: nodes that face contact in the present state. Nodes
/// that change too often keep their status, because they are at the edge of contact as in ActiveSet.
NodeFlags next_facing(const SidedPass& pass, NodeFlags facing);
/// Sets the nodes that face contact in the iteration that has begun, and counts the changes.
void hold_facing(SidedPass& pass, const NodeFlags& facing);

/// The given nodes together with the joined nodes of a surface.
NodeFlags with_joined(NodeFlags nodes, const SurfaceMesh& mesh);

/// True if nodes whose status was kept after too many changes should have another status at a solution, according to
/// `facing`. It then resets all counts, so that these nodes are tried once more; at most once after the start of
/// iterations.
bool reconsiders_facing(SidedPass& pass, const NodeFlags& facing);

/// Outward unit normals at the nodes, along the sum of the area vectors of the facets around each node; shape (3,
/// nodes).
Matrix3Xd nodal_normals(const SurfaceMesh& mesh, const Matrix3Xd& position);

}  // namespace mixture_contact
