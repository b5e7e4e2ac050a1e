/// A solution with a matrix that has been factorised.
#pragma once

#include <functional>
#include <vector>

namespace newton {

/// K^-1 times a right-hand side.
using Solve = std::function<std::vector<double>(const std::vector<double>& right)>;

}  // namespace newton
