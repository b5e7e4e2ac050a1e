/// The view of a facet where a body meets itself.
#pragma once

#include "geometry/surface.h"

#include <vector>

namespace mixture_contact {

/// A point sees neither its own facet nor one that shares a node with it. (How far normals have to oppose each other is
/// the same for all contacts.)
///
/// Behind it, through its own body, it sees the far side of that body, whose normal opposes its own as that of an
/// overlapping facet does. The far side is at least one element away: an overlap counts up to half the thickness of the
/// element behind the point.
class SelfContact {
 public:
  /// Surfaces that have nothing in common: all is seen.
  SelfContact() = default;
  SelfContact(const SurfaceMesh& primary, const SurfaceMesh& secondary);

  /// Whether a body meets itself.
  bool is_active() const { return neighbours_.count() > 0; }
  /// Whether a primary facet never sees a secondary one.
  bool excludes(int primary, int secondary) const;
  /// Keeps the facets that a primary one may face.
  void keep_visible(int primary, std::vector<int>& secondary) const;
  /// The largest overlap that counts at a primary facet [mm].
  double largest_overlap(int primary) const;

  std::size_t memory() const;

 private:
  IndexedVector<std::vector<int>> neighbours_;  ///< per primary facet: secondary ones with a node of it, ascending
  VectorXd largest_overlap_;                    ///< per primary facet
};

/// The largest overlap that counts at each node of a surface [mm]: the smallest of the facets around it. Empty if
/// the surface does not meet itself.
VectorXd largest_overlaps_of_nodes(const SurfaceMesh& mesh);

}  // namespace mixture_contact
