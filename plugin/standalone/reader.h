/// Reads a model: the subset of FEBio XML 4.0 that this host supports.
#pragma once

#include "model.h"

#include <string>

namespace standalone {

/// Reads a .feb file. Throws InputError, naming tag and line, for whatever is malformed, inconsistent or not supported.
Model read_model(const std::string& path);

}  // namespace standalone
