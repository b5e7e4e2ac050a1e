/// A line search in repeated attempts at a step.
///
/// If bonds soften, full increments of Newton's method may overshoot and invert elements, in particular when the last
/// bonds of a layer break and its strain is released. Shorter steps end at the same jump. A line search leads over it;
/// without need it would only cost evaluations.
#pragma once

#include "devices.h"
#include "helper.h"

#include <functional>
#include <optional>
#include <utility>

namespace newton {

/// The helper that enables the solver's line search after a failed attempt, until the step is solved.
class SearchAfterFailure : public Helper {
 public:
  /// `is_needed`: true if the attempt that has failed may have failed for want of a line search.
  SearchAfterFailure(std::function<bool()> is_needed, DeviceRecord& record)
      : is_needed_(std::move(is_needed)), record_(record) {}

  void rewind(Solver& solver) override;
  void end_step(Solver& solver) override { let_go(solver); }
  void let_go(Solver& solver) override;

 private:
  /// The user's settings of the line search.
  struct Given {
    double tolerance;
    bool halves_inversions;
  };

  std::function<bool()> is_needed_;
  DeviceRecord& record_;
  std::optional<Given> given_;  ///< the user's settings while the helper has changed them
};

}  // namespace newton
