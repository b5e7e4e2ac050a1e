/// Nodes that a tie couples for ever: weights over nodes of both surfaces, found once in the reference configuration.
#pragma once

#include "base/patch.h"
#include "base/settings.h"
#include "geometry/surface.h"

namespace mixture_contact {

/// The average of a jump around a node, secondary less primary side: weights times the values of the nodes.
struct TiedAverage {
  double area = 0;   ///< INT psi_a dA where facets of both sides let the quantity through, in the reference [mm^2]
  VectorXd weights;  ///< INT psi_a (N2, -N1) dA over the area; they add up to zero

  bool exists() const { return area > 0; }
};

/// A place on a primary facet, at which it has a normal.
struct PlaceOnFacet {
  IndexedVector<Index> places;  ///< of the facet's nodes among those of the tied node
  FacetGradient gradient;       ///< of their shape functions at the place
};

/// An initial gap that is kept along the present normal of a primary facet.
struct KeptGap {
  PlaceOnFacet at;
  double size = 0;  ///< INT psi_a g0 dA over the area, of the point [mm]
};

/// A primary node with the points that its averages are taken over.
struct TiedNode {
  int node = 0;  ///< of the primary surface
  IndexedVector<int> primary;
  IndexedVector<int> secondary;
  TiedAverage traction;
  IndexedVector<TiedAverage> fields;  ///< per exchanged scalar field
  VectorXd secondary_shares;          ///< the parts of the area that belong to the secondary nodes; they add up to one
  IndexedVector<KeptGap> gaps;        ///< empty where the surfaces touch
  IndexedVector<PlaceOnFacet> corners;  ///< the node on its facets, for its normal; empty where nothing asks for it

  Index count() const { return primary.count() + secondary.count(); }
  bool exchanges(int field) const { return fields[field].exists(); }
};

/// The nodes of a primary surface that a tie leaves free.
struct UntiedNodes {
  int facing_nothing = 0;
  int too_far = 0;              ///< beyond the search radius
  double largest_distance = 0;  ///< of those, along their normals [mm]

  int count() const { return facing_nothing + too_far; }
};

/// Finds the tied nodes and the weights of their averages. Weights and areas are those of the sliding contact's
/// averages, at these positions. Gaps that are rounding of the positions count as none.
IndexedVector<TiedNode> find_tied_nodes(const PerSide<SurfaceMesh>& mesh, const Effects& effects,
                                        const Settings& settings, const PerSide<Matrix3Xd>& reference);

/// Has tied nodes know the facets around them, which their normals follow.
void find_normals(IndexedVector<TiedNode>& nodes, const SurfaceMesh& primary);

/// The other nodes of the primary surface.
UntiedNodes untied_nodes(const IndexedVector<TiedNode>& tied, const PerSide<SurfaceMesh>& mesh,
                         const Settings& settings, const PerSide<Matrix3Xd>& reference);

/// Positions of the primary nodes once those that are tied have closed their gaps along their normals.
Matrix3Xd without_gaps(const IndexedVector<TiedNode>& tied, const PerSide<SurfaceMesh>& mesh, const Settings& settings,
                       const PerSide<Matrix3Xd>& reference);

}  // namespace mixture_contact
