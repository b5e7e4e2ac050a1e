/// Secondary nodes inside the primary body that the laws at primary nodes do not resolve.
#pragma once

#include "interface/facing_nodes.h"

namespace mixture_contact {

/// Secondary nodes inside the primary body at facets away from contact, which share no node with one that has a node in
/// contact. The laws hold for averages around primary nodes: a feature smaller than a primary facet may overlap it
/// without any load, unless a second pass resolves it. The averages cover facets next to contact: an overlap there is
/// the error of the edge of contact, which no second pass reduces.
struct UndetectedPenetration {
  int nodes = 0;     ///< number of nodes deeper than penetration_tolerance
  double depth = 0;  ///< of the deepest [mm]
  double share = 0;  ///< largest depth over the longest edge of the facet that the node faces [-]
};

/// The overlap of sound meshes, relative to the longest edge of a facet: facets bulge out of the arc between their
/// ends, or stay behind it, by 1/8 of the angle of that arc, here 0.4 (16 facets around a circle).
inline constexpr double penetration_tolerance = 0.05;

/// For each secondary node, its overlap with a primary facet away from contact, over the facet's longest edge; else 0.
VectorXd overlap_shares(const IndexedVector<FacingNode>& nodes, const NodeFlags& primary_in_contact,
                        const IndexedVector<Facet>& primary, const Matrix3Xd& x1);

/// The penetration of all nodes that lie deeper than the tolerance, except those in `but`. `shares`: as
/// overlap_shares().
UndetectedPenetration overlap_among(const IndexedVector<FacingNode>& nodes, const VectorXd& shares,
                                    const NodeFlags& but);

/// The penetration-check nodes with those added that face the same primary facets as a node deeper than the tolerance.
NodeFlags with_entered(NodeFlags check_nodes, const IndexedVector<FacingNode>& nodes, const VectorXd& shares,
                       Index primary_facets);

/// The pass that is restricted to penetration-check nodes, and the remaining overlap.
struct PenetrationCheck {
  Settings settings;                 ///< of the pass
  NodeFlags nodes;                   ///< secondary nodes that it is restricted to
  UndetectedPenetration undetected;  ///< overlap without load after the last check
};

/// Settings of the pass that is restricted to penetration-check nodes: those of the first one, without unknown
/// multipliers, for which there is no room on both surfaces.
Settings settings_of_check(Settings settings);

}  // namespace mixture_contact
