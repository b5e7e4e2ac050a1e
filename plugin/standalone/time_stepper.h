/// Chooses time increments: fixed ones, or FEBio's automatic ones with must points.
#pragma once

#include "log.h"
#include "model.h"

namespace standalone {

/// FEBio's rules: the increment follows the number of iterations that the last step took, stays below the largest one,
/// and is cut so that no must point is passed.
class TimeStepper {
 public:
  TimeStepper(const Model& model, Log& log);

  double increment() const { return increment_; }  ///< [s]
  /// Chooses the increment from `time` on, after a step that took `iterations` (0: at the start).
  void advance(double time, int iterations);
  /// Chooses a smaller increment after a failed step. Returns false if no retries are left.
  bool retry();
  void succeeded() { retries_ = 0; }

 private:
  const LoadCurve& must_points() const { return at(model_.curves, rules_->must_points); }
  double grown(double time, int iterations) const;
  double up_to_must_point(double time, double dt) const;

  const Model& model_;
  Log& log_;
  const StepControl* rules_;  ///< null for fixed increments
  double increment_;
  double wanted_;  ///< without the cut for a must point
  int retries_ = 0;
};

}  // namespace standalone
