#include "penalty_reduction.h"

#include <algorithm>
#include <cmath>

namespace mixture_contact {
namespace {

/// Largest number of accepted steps until a recovery is tried again.
constexpr int most_patience = 64;

}  // namespace

double PenaltyReduction::divisor() const { return std::pow(per_level, level_); }

ReducedPenalty PenaltyReduction::at(double dt) const {
  return {divisor(), fading_ > 0 ? 1 - std::min(1.0, dt / fading_) : 1.0};
}

bool PenaltyReduction::fail(double dt) {
  fading_ = is_full() ? dt : std::max(fading_, dt);
  if (recovered_ > 0) patience_ = std::min(2 * patience_, most_patience);
  accepted_ = recovered_ = 0;
  if (level_ == most_levels) return false;
  level_ = most_levels;
  return true;
}

void PenaltyReduction::accept() {
  if (is_full()) {
    // A step with full penalties has been accepted: the next recovery may be faster.
    recovered_ = 0;
    patience_ = std::max(1, patience_ / 2);
    return;
  }
  if (++accepted_ < patience_) return;
  accepted_ = 0;
  ++recovered_;
  --level_;
}

}  // namespace mixture_contact
