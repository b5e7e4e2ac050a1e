#include "law/openings.h"

#include <cmath>
#include <limits>
#include <utility>

namespace mixture_contact {

VectorXd openings(const NodalLaws& laws, const NodalGaps& now) {
  VectorXd found = VectorXd::Constant(laws.nodes(), std::numeric_limits<double>::infinity());
  for (Index node = 0; node < laws.nodes(); ++node) {
    if (!now.faces(node)) continue;
    const double traction = laws.multipliers.traction[node] + laws.traction_penalty(node) * now.gap[node];
    found[node] = traction < 0 ? traction / laws.penalties().stiffness[node] : now.gap[node];
  }
  return found;
}

void start_openings(NodalLaws& laws, const NodalGaps& now) {
  VectorXd& known = laws.multipliers.opening;
  if (known.array().isInf().all()) known = openings(laws, now);
}

void take_openings(NodalLaws& laws, const NodalGaps& now, double dt) {
  Multipliers& taken = laws.multipliers;
  const VectorXd before = std::exchange(taken.opening, openings(laws, now));
  for (Index node = 0; node < laws.nodes(); ++node) {
    const double change = taken.opening[node] - before[node];
    taken.opening_rate[node] = std::isfinite(change) ? change / dt : 0.0;
  }
}

VectorXd expected_openings(const NodalLaws& laws, const NodalGaps& now, double ahead) {
  return openings(laws, now) + ahead * laws.multipliers.opening_rate;
}

}  // namespace mixture_contact
