/// Solution with a factorised matrix.
#pragma once

#include "indexing/entries.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace newton {

/// Returns K^-1 times a right-hand side.
using Solve = std::function<std::vector<double>(const std::vector<double>& right)>;

/// Returns K^-1 times right-hand sides, which are the columns of a matrix. Several ones take less time together than
/// one after the other.
using SolveAll = std::function<Eigen::MatrixXd(Eigen::MatrixXd rights)>;

/// A view of values for Eigen, without a copy.
inline Eigen::Map<const Eigen::VectorXd> as_vector(const std::vector<double>& values) {
  return {values.data(), indexing::number_of(values)};
}

}  // namespace newton
