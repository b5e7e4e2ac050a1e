#include "tie/bond_iterations.h"

#include <algorithm>
#include <utility>

namespace mixture_contact {

IndexedVector<BondIterations::Phase> BondIterations::phases_of(const Tie& tie, const TieLoads& loads) {
  IndexedVector<Phase> phases;
  for (Index n = 0; n < tie.nodes().count(); ++n) {
    const double damage = loads.damage[n];
    const bool grows = damage > tie.state().damage.damage[n];
    phases.push_back(!grows ? Phase::constant : damage < 1 ? Phase::growing : Phase::failed);
  }
  return phases;
}

double BondIterations::quotient(const Matrix3Xd& move, const Matrix3Xd& last) {
  return move.cwiseProduct(last).sum() / last.squaredNorm();
}

double BondIterations::next_softening(double quotient) const {
  if (quotient < 0) return 0;
  const double rho = quotient / (1 - before_ + quotient * softening_);
  const double missing = 0.5 * (1 - softening_);
  return rho > 1 ? std::max(0.0, 1 / rho - missing) : 1 - missing;
}

bool BondIterations::is_any_softening() const {
  return std::any_of(phases_.begin(), phases_.end(), [](Phase phase) { return phase != Phase::constant; });
}

void BondIterations::begin(const Tie& tie, const PerSide<SurfaceFields>& fields) {
  if (!std::holds_alternative<Cohesive>(tie.breaking())) return;
  const TieLoads loads = tie.loads(fields);
  IndexedVector<Phase> phases = phases_of(tie, loads);
  if (!phases_.empty()) {
    const Matrix3Xd last = std::exchange(move_, loads.gap - gaps_);
    if (last.size() > 0 && softening_ <= 0 && move_.cwiseProduct(last).sum() < 0) turned_back_ = true;
    const bool is_quiet = std::equal(phases.begin(), phases.end(), phases_.begin());
    quiet_ = is_quiet ? quiet_ + 1 : 0;
    // The move before the first quiet one was of other phases.
    const double next = quiet_ < 2 ? 0.0 : next_softening(quotient(move_, last));
    before_ = std::exchange(softening_, next);
  }
  phases_ = std::move(phases);
  gaps_ = loads.gap;
}

}  // namespace mixture_contact
