/// An analysis from its start to its end.
#pragma once

#include "log.h"
#include "model.h"

namespace standalone {

/// Runs a model, its steps, output and summary, as FEBio would. Returns whether it got to its end.
/// Throws InputError if the model turns out not to be one that can be run.
bool run(const Model& model, Log& log);

}  // namespace standalone
