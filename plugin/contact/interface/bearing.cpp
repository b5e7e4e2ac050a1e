/// Which nodes bear the load of facets that are covered in part: a part of ContactPass.
#include "base/parallel.h"
#include "interface/pass.h"

#include <cmath>
#include <map>

namespace mixture_contact {
namespace {

/// A node bears nothing of the load of a facet where the covered part of its share of the facet is less than this part
/// of the best covered node's. Where the other surface ends across a facet and covers s of it, far nodes have s^2 and
/// near ones 2s - s^2 of theirs: they bear from s = 0.82 on.
constexpr double least_covered = 0.7;
/// But nodes this far away, as a part of the facet's size, have no load that others could bear.
constexpr double far_away = 0.01;

/// 1 for nodes of a facet that bear load, 0 for the others. `seen`: INT psi_a da and INT psi_a g da over the covered
/// part of the facet; `whole`: INT psi_a da over all of it [mm^2].
FacetVector bearing_nodes(const SeenGaps& seen, const FacetVector& whole) {
  const FacetVector covered = seen.row(0);
  const FacetVector part = covered.cwiseQuotient(whole);
  const double enough = least_covered * part.maxCoeff();
  const double near = far_away * std::sqrt(whole.sum());
  FacetVector bearing = FacetVector::Ones(whole.size());
  for (Index a = 0; a < whole.size(); ++a) {
    if (part[a] < enough && seen(1, a) <= near * covered[a]) bearing[a] = 0;
  }
  return bearing;
}

}  // namespace

void ContactPass::find_bearing_nodes(const Matrix3Xd& x1, const Matrix3Xd& x2) {
  // Nodes that a limited pass is for keep their conditions: there are no others to bear their load.
  if (settings_.integration != Integration::segments || limited_to_) return;
  bearing_.resize(primary_.facets.size());
  std::vector<const FacetPair*> unknown;
  for (const FacetPair& pair : pairs_) {
    if (bearing_[static_cast<std::size_t>(pair.primary)].size() == 0) unknown.push_back(&pair);
  }
  std::map<int, SeenGaps> seen;
  in_order(
      unknown.size(), [&](std::size_t index) { return gap_sums(*unknown[index], x1, x2); },
      [&](std::size_t index, const SeenGaps& sums) {
        const auto [place, first] = seen.try_emplace(unknown[index]->primary, sums);
        if (!first) place->second += sums;
      });
  for (const auto& [index, sums] : seen) {
    const auto facet = static_cast<std::size_t>(index);
    bearing_[facet] = bearing_nodes(sums, areas_of_nodes(primary_.facets[facet], x1));
  }
}

}  // namespace mixture_contact
