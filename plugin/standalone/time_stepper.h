/// Time increments: constant ones, or FEBio's automatic ones with must points.
#pragma once

#include "log.h"
#include "model.h"

#include <optional>

namespace standalone {

/// FEBio's rules for time steps: the increment depends on the number of iterations of the last step, is limited by the
/// largest one, and is shortened to meet must points.
class TimeStepper {
 public:
  TimeStepper(const Model& model, Log& log);

  double increment() const { return increment_; }  ///< present increment [s]
  /// Chooses the increment of the step that starts at `time`. `iterations`: number of iterations of the last step; 0 at
  /// the start.
  void advance(double time, int iterations, Log& log);
  /// Chooses a smaller increment after a failed step. Returns false if no retries are left.
  bool retry(Log& log);
  /// Notes that the step has succeeded.
  void succeeded() { retries_ = 0; }

 private:
  double grown(const StepControl& rules, double time, int iterations) const;
  double up_to_must_point(double time, double dt, Log& log) const;

  std::optional<StepControl> rules_;  ///< empty for constant increments
  LoadCurve must_points_;             ///< empty if the rules have none
  double end_;                        ///< end of the analysis [s]
  double increment_;
  double wanted_;  ///< increment before it was shortened for a must point [s]
  int retries_ = 0;
};

}  // namespace standalone
