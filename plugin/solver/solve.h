/// Solution with a factorised matrix.
#pragma once

#include <functional>
#include <vector>

namespace newton {

/// Returns K^-1 times a right-hand side.
using Solve = std::function<std::vector<double>(const std::vector<double>& right)>;

}  // namespace newton
