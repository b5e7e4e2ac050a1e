#include "integration/self_contact.h"

#include "base/bytes.h"

#include <algorithm>
#include <limits>
#include <map>

namespace mixture_contact {
namespace {

constexpr double largest_overlap_share = 0.5;  // fraction of an element's thickness

/// The facets around each node, by its number in the host's mesh.
std::map<int, std::vector<int>> facets_around(const SurfaceMesh& mesh) {
  std::map<int, std::vector<int>> around;
  for (int f = 0; f < mesh.facets.count(); ++f) {
    for (const int node : mesh.facets[f]) around[mesh.node_ids[node]].push_back(f);
  }
  return around;
}

void sort_unique(std::vector<int>& facets) {
  std::sort(facets.begin(), facets.end());
  facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
}

}  // namespace

SelfContact::SelfContact(const SurfaceMesh& primary, const SurfaceMesh& secondary) {
  if (!primary.may_meet_itself()) return;
  const std::map<int, std::vector<int>> around = facets_around(secondary);
  for (const Facet& facet : primary.facets) {
    std::vector<int> found;
    for (const int node : facet) {
      const auto entry = around.find(primary.node_ids[node]);
      if (entry != around.end()) found.insert(found.end(), entry->second.begin(), entry->second.end());
    }
    sort_unique(found);
    neighbours_.push_back(std::move(found));
  }
  largest_overlap_ = largest_overlap_share * primary.thickness;
}

bool SelfContact::excludes(int primary, int secondary) const {
  return is_active() && std::binary_search(neighbours_[primary].begin(), neighbours_[primary].end(), secondary);
}

void SelfContact::keep_visible(int primary, std::vector<int>& secondary) const {
  const auto is_excluded = [&](int facet) { return excludes(primary, facet); };
  secondary.erase(std::remove_if(secondary.begin(), secondary.end(), is_excluded), secondary.end());
}

double SelfContact::largest_overlap(int primary) const {
  return largest_overlap_.size() > 0 ? largest_overlap_[primary] : std::numeric_limits<double>::infinity();
}

std::size_t SelfContact::memory() const {
  std::size_t sum = bytes(neighbours_) + bytes(largest_overlap_);
  for (const std::vector<int>& facets : neighbours_) sum += facets.capacity() * sizeof(int);
  return sum;
}

VectorXd largest_overlaps_of_nodes(const SurfaceMesh& mesh) {
  if (!mesh.may_meet_itself()) return {};
  VectorXd overlaps = VectorXd::Constant(mesh.nodes, std::numeric_limits<double>::infinity());
  for (int f = 0; f < mesh.facets.count(); ++f) {
    for (const int node : mesh.facets[f])
      overlaps[node] = std::min(overlaps[node], largest_overlap_share * mesh.thickness[f]);
  }
  return overlaps;
}

}  // namespace mixture_contact
