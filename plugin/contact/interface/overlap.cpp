#include "interface/overlap.h"

#include <algorithm>

namespace mixture_contact {

Overlap largest_overlap(const ContactInterface& contact, const PerSide<SurfaceFields>& fields) {
  Overlap found;
  for (std::size_t n = 0; n < contact.passes(); ++n) {
    const Side side = both_sides.at(n);
    const NodalLoads loads = contact.pass(n).nodal_loads(seen_from(side, fields));
    const VectorXd edges = longest_edges(contact.mesh(side), fields[side].position);
    for (Index node = 0; node < edges.size(); ++node) {
      if (!loads.in_contact[node] || !(loads.gap[node] < 0)) continue;
      found.depth = std::max(found.depth, -loads.gap[node]);
      found.share = std::max(found.share, -loads.gap[node] / edges[node]);
    }
  }
  return found;
}

}  // namespace mixture_contact
