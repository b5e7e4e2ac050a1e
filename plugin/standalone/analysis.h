/// An analysis from its start to its end.
#pragma once

#include "log.h"
#include "model.h"

namespace standalone {

/// Runs a model, its steps, output and summary, as FEBio would. Returns whether it got to its end.
/// Throws InputError where the model turns out not to be one that can be run.
bool run(Model model, Log& log);

/// Moves primary nodes that overlap the other surface onto it, for the contacts that ask for it (node_reloc).
void relocate_nodes(Model& model);

}  // namespace standalone
