#include "time_stepper.h"

#include <algorithm>
#include <cmath>

namespace standalone {

TimeStepper::TimeStepper(const Model& model, Log& log)
    : rules_(model.control.stepper), end_(model.control.end), increment_(model.control.step_size), wanted_(increment_) {
  if (rules_ && rules_->must_points >= 0) must_points_ = at(model.curves, rules_->must_points);
  advance(0, 0, log);
}

double TimeStepper::grown(const StepControl& rules, double time, int iterations) const {
  constexpr double largest_growth = 0.2;
  constexpr double largest_factor = 5;
  const double largest = rules.must_points < 0 ? rules.largest : must_points_.at(time);
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

void TimeStepper::advance(double time, int iterations, Log& log) {
  if (!rules_) return;
  const double last = increment_;
  wanted_ = grown(*rules_, time, iterations);
  if (wanted_ != last) {
    log.print("\nAUTO STEPPER: %s time step, dt = %g\n\n", wanted_ > last ? "increasing" : "decreasing", wanted_);
  }
  increment_ = std::min(up_to_must_point(time, wanted_, log), end_ - time);
}

double TimeStepper::up_to_must_point(double time, double dt, Log& log) const {
  const double near = end_ * 1e-12;
  for (const auto& point : must_points_.points) {
    if (point[0] < time + near) continue;
    if (point[0] >= time + dt + near) return dt;
    log.print("MUST POINT CONTROLLER: adjusting time step. dt = %g\n\n", point[0] - time);
    return point[0] - time;
  }
  return dt;
}

bool TimeStepper::retry(Log& log) {
  if (!rules_) return false;
  if (retries_ >= rules_->max_retries) {
    log.print("Max. nr of retries reached.\n\n");
    return false;
  }
  log.print("Retrying time step. Retry attempt %d of max %d\n\n", retries_ + 1, rules_->max_retries);
  increment_ *= rules_->cutback;
  log.print("\nAUTO STEPPER: retry step, dt = %g\n\n", increment_);
  wanted_ = increment_;
  ++retries_;
  return true;
}

}  // namespace standalone
