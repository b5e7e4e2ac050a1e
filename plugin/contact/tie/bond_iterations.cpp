#include "tie/bond_iterations.h"

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

void BondIterations::compare(const IndexedVector<Phase>& phases, const Matrix3Xd& gaps) {
  const double move = (gaps - gaps_).norm();
  contractions_ = move < contraction * move_ ? contractions_ + 1 : 0;
  move_ = move;
  if (contractions_ >= enough_contractions) softening_ = Softening::exact;
  for (Index n = 0; n < phases.count(); ++n) {
    if (phases[n] == phases_[n]) continue;
    contractions_ = 0;
    if (++changes_[n] > most_phase_changes) softening_ = Softening::yielding;
  }
}

void BondIterations::begin(const Tie& tie, const PerSide<SurfaceFields>& fields) {
  if (!std::holds_alternative<Cohesive>(tie.breaking())) return;
  const TieLoads loads = tie.loads(fields);
  IndexedVector<Phase> phases = phases_of(tie, loads);
  if (phases_.empty()) {
    changes_.assign(phases.size(), 0);
  } else {
    compare(phases, loads.gap);
  }
  phases_ = std::move(phases);
  gaps_ = loads.gap;
}

}  // namespace mixture_contact
