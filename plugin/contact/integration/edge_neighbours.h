/// Neighbours of the facets of a surface across their edges.
#pragma once

#include "geometry/surface.h"

#include <array>
#include <optional>

namespace mixture_contact {

/// For each edge of each facet of a surface, the facet on the other side of the edge.
class EdgeNeighbours {
 public:
  /// An empty table: across() finds no neighbour for any facet.
  EdgeNeighbours() = default;
  /// Builds the table for a mesh, and keeps a reference to the mesh.
  explicit EdgeNeighbours(const SurfaceMesh& mesh);

  /// The neighbour of a facet across the edge from a corner to the next corner. Empty if the neighbour is permeable to
  /// other fields, if the surface ends or folds at the edge, or if more than two facets meet there.
  std::optional<int> across(int facet, int corner) const;
  /// Memory of the table [bytes].
  std::size_t memory() const;

 private:
  /// Entry of an edge without a neighbour.
  static constexpr int none = -1;

  const SurfaceMesh* mesh_ = nullptr;
  IndexedVector<std::array<int, 4>> neighbours_;  ///< per facet, in the order of its edges: the neighbour or `none`
};

}  // namespace mixture_contact
