#include "time_stepper.h"

#include <algorithm>
#include <cmath>

namespace standalone {

TimeStepper::TimeStepper(const Model& model, Log& log)
    : model_(model), log_(log), increment_(model.control.step_size), wanted_(increment_) {
  if (model.control.stepper) advance(0, 0);
}

double TimeStepper::grown(double time, int iterations) const {
  constexpr double largest_growth = 0.2;
  constexpr double largest_factor = 5;
  // NOLINTNEXTLINE(bugprone-unchecked-optional-access): only asked where there is a stepper
  const StepControl& rules = *model_.control.stepper;
  const double largest = rules.must_points < 0 ? rules.largest
                                               : model_.curves[static_cast<std::size_t>(rules.must_points)].at(time);
  if (rules.force) return largest;
  double dt = std::max(wanted_, rules.least);
  const double scale = iterations > 0 ? std::sqrt(static_cast<double>(rules.optimal_iterations) / iterations) : 1.0;
  if (iterations > 0 && scale >= 1) {
    dt += (largest - dt) * std::min(largest_growth, scale - 1);
    dt = std::min(dt, largest_factor * wanted_);
  } else if (iterations > 0) {
    dt -= (dt - rules.least) * (1 - scale);
  }
  if (scale < 1 || iterations == 0) dt = std::max(dt, rules.least);
  return largest > 0 ? std::min(dt, largest) : dt;
}

void TimeStepper::advance(double time, int iterations) {
  if (!model_.control.stepper) return;
  const double last = increment_;
  wanted_ = grown(time, iterations);
  if (wanted_ != last) {
    log_.print("\nAUTO STEPPER: %s time step, dt = %g\n\n", wanted_ > last ? "increasing" : "decreasing", wanted_);
  }
  increment_ = std::min(up_to_must_point(time, wanted_), model_.control.end - time);
}

double TimeStepper::up_to_must_point(double time, double dt) const {
  // NOLINTNEXTLINE(bugprone-unchecked-optional-access): only asked where there is a stepper
  const int curve = model_.control.stepper->must_points;
  if (curve < 0) return dt;
  const double near = model_.control.end * 1e-12;
  for (const auto& point : model_.curves[static_cast<std::size_t>(curve)].points) {
    if (point[0] < time + near) continue;
    if (point[0] >= time + dt + near) return dt;
    log_.print("MUST POINT CONTROLLER: adjusting time step. dt = %g\n\n", point[0] - time);
    return point[0] - time;
  }
  return dt;
}

bool TimeStepper::retry() {
  if (!model_.control.stepper) return false;
  const StepControl& rules = *model_.control
                                  .stepper;  // NOLINT(bugprone-unchecked-optional-access): asked by next() only
  if (retries_ >= rules.max_retries) {
    log_.print("Max. nr of retries reached.\n\n");
    return false;
  }
  log_.print("Retrying time step. Retry attempt %d of max %d\n\n", retries_ + 1, rules.max_retries);
  increment_ *= rules.cutback;
  log_.print("\nAUTO STEPPER: retry step, dt = %g\n\n", increment_);
  wanted_ = increment_;
  ++retries_;
  return true;
}

}  // namespace standalone
