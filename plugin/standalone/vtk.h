/// Files for ParaView: VTK's XML formats.
#pragma once

#include "model.h"

namespace standalone {

/// Writes the mesh with u, p~ and each c~ at the nodes as an unstructured grid (.vtu). Throws InputError where it
/// cannot.
void write_vtu(const std::string& path, const Model& model, const MatrixXd& values);

/// Writes the list of states, time [s] and file of each, that ParaView opens (.pvd).
void write_pvd(const std::string& path, const std::vector<std::pair<double, std::string>>& states);

}  // namespace standalone
