/// The neighbours across the edges of the facets of a surface.
#pragma once

#include "geometry/surface.h"

#include <array>
#include <optional>

namespace mixture_contact {

class EdgeNeighbours {
 public:
  /// Neighbours on a surface of which nothing is known: no facet has any.
  EdgeNeighbours() = default;
  /// Keeps a reference.
  explicit EdgeNeighbours(const SurfaceMesh& mesh);

  /// The neighbour of a facet across the edge from a corner to the next one, where it lets the same fields through.
  /// Empty if the surface ends or folds, or where more than two facets meet.
  std::optional<int> across(int facet, int corner) const;
  std::size_t memory() const;

 private:
  static constexpr int none = -1;

  const SurfaceMesh* mesh_ = nullptr;
  IndexedVector<std::array<int, 4>> neighbours_;  ///< per facet, by the first corner of the edge
};

}  // namespace mixture_contact
