/// Restrictions on pairs of facets where a body meets itself.
#pragma once

#include "geometry/surface.h"

#include <vector>

namespace mixture_contact {

/// The facets that cannot be paired where a surface is in contact with itself.
///
/// A facet is paired neither with itself nor with a facet that shares a node with it.
///
/// A ray backwards from a point, through its own body, meets the far side of that body, whose normal opposes its own in
/// the same way as that of an overlapping facet. The far side is at least one element away. An overlap therefore counts
/// only up to half the thickness of the element behind the point.
class SelfContact {
 public:
  /// Two surfaces without common facets: no pair is excluded.
  SelfContact() = default;
  SelfContact(const SurfaceMesh& primary, const SurfaceMesh& secondary);

  /// True if the surfaces are those of one body.
  bool is_active() const { return neighbours_.count() > 0; }
  /// True if a primary and a secondary facet are never paired.
  bool excludes(int primary, int secondary) const;
  /// Removes from a list of secondary facets those that are never paired with a primary facet.
  void keep_visible(int primary, std::vector<int>& secondary) const;
  /// The largest overlap that counts at a primary facet [mm]; infinite if the body does not meet itself.
  double largest_overlap(int primary) const;

  std::size_t memory() const;

 private:
  /// Per primary facet: the secondary facets that share a node with it, ascending.
  IndexedVector<std::vector<int>> neighbours_;
  VectorXd largest_overlap_;  ///< largest overlap that counts, per primary facet [mm]
};

/// The largest overlap that counts at each node of a surface [mm]: the smallest of those of its facets. Empty if the
/// surface does not meet itself.
VectorXd largest_overlaps_of_nodes(const SurfaceMesh& mesh);

}  // namespace mixture_contact
