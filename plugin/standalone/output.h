/// The output of a run besides its log: data files in FEBio's format, and files for ParaView.
#pragma once

#include "problem.h"

#include <fstream>

namespace standalone {

/// Writes the state of a problem to all files of its model's output, in the folder of the model.
class Output {
 public:
  /// Opens the files; throws InputError where one cannot be written.
  explicit Output(const Problem& problem);

  /// Writes the state at the end of a step (0: the initial one) at `time` [s].
  void write(int step, double time);

 private:
  void write_data(std::size_t file, int step, double time);
  void write_vtk(int step, double time);

  const Problem& problem_;
  std::vector<std::ofstream> streams_;                  ///< one per data file of the model
  std::vector<std::pair<double, std::string>> states_;  ///< time [s] and .vtu file of each state written
};

}  // namespace standalone
