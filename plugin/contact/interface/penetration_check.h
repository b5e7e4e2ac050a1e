/// Secondary nodes inside the primary body that the laws at primary nodes do not resolve.
#pragma once

#include "interface/facing_nodes.h"

namespace mixture_contact {

/// Secondary nodes inside the primary body at facets away from contact, which share no node with a facet that has a
/// node in contact.
///
/// The laws apply to averages around primary nodes. A feature smaller than a primary facet may therefore overlap with
/// it without load, unless a second pass resolves it. At facets next to contact, an overlap is the error of the edge of
/// contact, which no second pass reduces.
struct UndetectedPenetration {
  int nodes = 0;     ///< number of nodes deeper than penetration_tolerance
  double depth = 0;  ///< largest depth [mm]
  double share = 0;  ///< largest depth relative to the length of overlap_shares() [-]
};

/// Largest overlap of sound meshes, relative to the longest edge of a facet of a curved surface. A facet deviates from
/// an arc between its ends by 1/8 of the angle of the arc, here 0.4 (16 facets around a circle).
inline constexpr double penetration_tolerance = 0.05;

/// Per secondary node, its overlap with a primary facet away from contact, relative to a length; 0 at all other nodes.
/// The length is the longest edge of the primary facet, in proportion to the angle between that facet and the next ones
/// below 0.4, but at least the longest edge around the node: a flat facet overlaps with nothing by its shape.
VectorXd overlap_shares(const IndexedVector<FacingNode>& nodes, const NodeFlags& primary_in_contact,
                        const PerSide<SurfaceMesh>& mesh, const PerSide<Matrix3Xd>& position);

/// The penetration of all nodes deeper than the tolerance, except the nodes in `but`. `shares`: result of
/// overlap_shares().
UndetectedPenetration overlap_among(const IndexedVector<FacingNode>& nodes, const VectorXd& shares,
                                    const NodeFlags& but);

/// The penetration-check nodes together with all nodes that face the same primary facets as a node deeper than the
/// tolerance.
NodeFlags with_entered(NodeFlags check_nodes, const IndexedVector<FacingNode>& nodes, const VectorXd& shares,
                       Index primary_facets);

/// The data of the penetration check: the restricted second pass, and the remaining overlap.
struct PenetrationCheck {
  Settings settings;                 ///< settings of the second pass
  NodeFlags nodes;                   ///< secondary nodes to which the second pass is restricted
  UndetectedPenetration undetected;  ///< overlap without load after the last check
};

/// Settings of the second pass that is restricted to penetration-check nodes: those of the first pass, but without
/// unknown multipliers, which are not possible on both surfaces.
Settings settings_of_check(Settings settings);

}  // namespace mixture_contact
