/// The analysis of a model from start to end.
#pragma once

#include "log.h"
#include "model.h"

namespace standalone {

/// Runs a model with its steps, output and summary, as FEBio would. Returns true if the analysis has reached its end.
/// Throws InputError if the model cannot be run.
bool run(const Model& model, Log& log);

}  // namespace standalone
