/// Output files of a run: data files in FEBio's format, and files for ParaView.
#pragma once

#include "problem.h"

#include <fstream>

namespace standalone {

/// Writes the state of a problem to all output files of its model, in the folder of the model.
class Output {
 public:
  /// Opens the files of a model. Throws InputError if one cannot be written.
  explicit Output(const Model& model);

  /// Writes the state at the end of a step (0: initial state) at `time` [s].
  void write(const Problem& problem, int step, double time);

 private:
  void write_data(const Problem& problem, std::size_t file, int step, double time);
  void write_vtk(const Problem& problem, int step, double time);

  std::vector<std::ofstream> streams_;                  ///< one stream per data file of the model
  std::vector<std::pair<double, std::string>> states_;  ///< time [s] and .vtu file of each state written
};

}  // namespace standalone
