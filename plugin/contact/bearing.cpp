/// Which nodes bear the load of facets that are covered in part: a part of ContactPass.
#include "parallel.h"
#include "pass.h"

#include <cmath>

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
  bearing_.clear();
  // Nodes that a limited pass is for keep their conditions: there are no others to bear their load.
  if (settings_.integration != Integration::segments || limited_to_ || pairs_.empty()) return;
  std::vector<SeenGaps> sums;
  for (const Facet& facet : primary_.facets) sums.push_back(SeenGaps::Zero(2, node_count(facet.type)));
  in_order(
      pairs_.size(), [&](std::size_t index) { return gap_sums(pairs_[index], x1, x2); },
      [&](std::size_t index, const SeenGaps& seen) { sums[static_cast<std::size_t>(pairs_[index].primary)] += seen; });
  for (std::size_t index = 0; index < sums.size(); ++index) {
    bearing_.push_back(bearing_nodes(sums[index], areas_of_nodes(primary_.facets[index], x1)));
  }
}

}  // namespace mixture_contact
