#include "integration/edge_neighbours.h"

#include "base/bytes.h"

#include <map>
#include <utility>

namespace mixture_contact {
namespace {

using Edge = std::pair<int, int>;  ///< the nodes of an edge, in the order of its facet

Edge edge_from(const Facet& facet, int corner) {
  return {facet.node(corner), facet.node((corner + 1) % corner_count(facet.type))};
}

Edge reversed(const Edge& edge) { return {edge.second, edge.first}; }

}  // namespace

EdgeNeighbours::EdgeNeighbours(const SurfaceMesh& mesh) : mesh_(&mesh) {
  std::map<Edge, std::vector<int>> facets_at;
  const auto for_each_edge = [&](const auto& use) {
    for (int facet = 0; facet < mesh.facets.count(); ++facet) {
      const Facet& of = mesh.facets[facet];
      for (int corner = 0; corner < corner_count(of.type); ++corner) use(facet, corner, edge_from(of, corner));
    }
  };
  for_each_edge([&](int facet, int /*corner*/, const Edge& edge) { facets_at[edge].push_back(facet); });
  neighbours_.fill(mesh.facets.count(), {none, none, none, none});
  for_each_edge([&](int facet, int corner, const Edge& edge) {
    const auto others = facets_at.find(reversed(edge));
    const bool is_joint = others != facets_at.end() && others->second.size() == 1 && facets_at[edge].size() == 1;
    if (is_joint) at(neighbours_[facet], corner) = others->second.front();
  });
}

std::optional<int> EdgeNeighbours::across(int facet, int corner) const {
  if (neighbours_.empty()) return std::nullopt;
  const int other = at(neighbours_[facet], corner);
  if (other == none || mesh_->permeable[other] != mesh_->permeable[facet]) return std::nullopt;
  return other;
}

std::size_t EdgeNeighbours::memory() const { return bytes(neighbours_); }

}  // namespace mixture_contact
