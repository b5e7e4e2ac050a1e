/// Storage of state for a restart.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace newton {

/// Writes values to the host's archive or reads them from it, depending on the mode of the archive.
class Archive {
 public:
  Archive() = default;
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;
  Archive(Archive&&) = delete;
  Archive& operator=(Archive&&) = delete;
  virtual ~Archive() = default;

  virtual void part(int& value) = 0;
  virtual void part(double& value) = 0;
  virtual void part(std::vector<double>& values) = 0;
  virtual void part(Eigen::MatrixXd& values) = 0;
};

}  // namespace newton
