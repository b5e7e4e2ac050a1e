/// Nodes of the primary surface that a tie couples to the secondary surface. Their averaging weights are computed once,
/// in the reference configuration.
#pragma once

#include "base/patch.h"
#include "base/settings.h"
#include "geometry/surface.h"
#include "tie/breaking.h"

namespace mixture_contact {

/// The average of a jump around a node, secondary minus primary side: the sum of weights times nodal values.
struct TiedAverage {
  /// INT psi_a dA over the facets whose both sides are permeable to the quantity, in the reference configuration
  /// [mm^2].
  double area = 0;
  VectorXd weights;  ///< weights of the nodes, INT psi_a (N2, -N1) dA divided by the area; they add up to zero

  bool exists() const { return area > 0; }
};

/// A point on a facet at which the normal is computed.
struct PlaceOnFacet {
  IndexedVector<int> nodes;  ///< nodes of the facet, indices on its surface
  FacetGradient gradient;    ///< gradients of their shape functions at the point
};

/// An initial gap of one point that is kept along the present normal of the primary facet.
struct KeptGap {
  PlaceOnFacet at;
  double size = 0;  ///< integral INT psi_a g0 dA of the point divided by the area of the node [mm]
};

/// A node of the primary surface with the nodes and weights of its averages.
struct TiedNode {
  int node = 0;  ///< index on the primary surface
  /// Primary nodes of the averages, ascending.
  IndexedVector<int> primary;
  /// Secondary nodes of the averages, ascending.
  IndexedVector<int> secondary;
  /// Average of the displacement jump.
  TiedAverage traction;
  IndexedVector<TiedAverage> fields;  ///< averages of the jumps of the exchanged scalar fields
  /// Means of the functions psi_b of the primary nodes, weighted with the share of the node in the load of its surface;
  /// they add up to one.
  VectorXd primary_shares;
  VectorXd secondary_shares;  ///< fractions of the node's area that belong to the secondary nodes; they add up to one
  PerSide<IndexedVector<int>> facets;  ///< facets of both surfaces over which the node is averaged
  IndexedVector<KeptGap> gaps;         ///< kept gaps of the points; empty if the surfaces touch
  /// The node as a point of each primary facet around it, for its normal; empty if no law requires this normal.
  IndexedVector<PlaceOnFacet> corners;
  /// The middles of the secondary facets around it, for their normal; empty if no law requires this normal.
  IndexedVector<PlaceOnFacet> faced;

  Index count() const { return primary.count() + secondary.count(); }
  bool exchanges(int field) const { return fields[field].exists(); }
};

/// The nodes of a primary surface that are not tied, by reason.
struct UntiedNodes {
  /// Number of nodes whose normals do not meet the secondary surface.
  int facing_nothing = 0;
  int too_far = 0;              ///< number of nodes farther away than the search radius
  double largest_distance = 0;  ///< largest distance of these nodes, along their normals [mm]

  int count() const { return facing_nothing + too_far; }
};

/// Finds the tied nodes and the weights of their averages at the reference positions. Areas are those of sliding
/// contact. Gaps within the rounding of the positions count as zero.
///
/// On linear facets that the other surface covers, psi_a are the dual functions of the shape functions: INT psi_a N_b
/// dA is zero for two nodes a and b (Wohlmuth 2000, SIAM J Numer Anal 38:989-1012; integrated over the covered part:
/// Cichosz and Bischoff 2011, Comput Methods Appl Mech Eng 200:1317-1332). An average then contains a single primary
/// node, and on matching meshes a single secondary node. On other facets, psi_a are those of sliding contact. They are
/// also those of cohesive bonds: neighbouring bonds then soften together, and the load of a crack varies less from node
/// to node.
IndexedVector<TiedNode> find_tied_nodes(const PerSide<SurfaceMesh>& mesh, const Effects& effects,
                                        const Settings& settings, const PerSide<Matrix3Xd>& reference,
                                        const BreakingLaw& breaking = Unbreakable());

/// Removes nodes without weight from the averages, except those of kept gaps.
void remove_uncoupled(IndexedVector<TiedNode>& nodes);

/// Sets TiedNode::corners: the facets around each tied node, from which its normal is computed.
void find_normals(IndexedVector<TiedNode>& nodes, const SurfaceMesh& primary);
/// Sets TiedNode::faced: the facets that each tied node faces, from which their normal is computed.
void find_faced_normals(IndexedVector<TiedNode>& nodes, const SurfaceMesh& secondary);

/// Counts the nodes of the primary surface that are not tied.
UntiedNodes untied_nodes(const IndexedVector<TiedNode>& tied, const PerSide<SurfaceMesh>& mesh,
                         const Settings& settings, const PerSide<Matrix3Xd>& reference);

/// The positions of the primary nodes after tied nodes have closed their gaps along their normals.
Matrix3Xd without_gaps(const IndexedVector<TiedNode>& tied, const PerSide<SurfaceMesh>& mesh, const Settings& settings,
                       const PerSide<Matrix3Xd>& reference);

}  // namespace mixture_contact
