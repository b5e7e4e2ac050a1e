/// Exceptions for the errors of a run.
#pragma once

#include <stdexcept>

namespace standalone {

/// A model that cannot be run; the text names the tag, its line and the fault.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A time step that has failed and may be repeated with a smaller increment.
struct StepFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace standalone
