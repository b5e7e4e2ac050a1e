/// Solution with a factorised matrix.
#pragma once

#include <functional>
#include <vector>

namespace newton {

/// Returns K^-1 times a right-hand side.
using Solve = std::function<std::vector<double>(const std::vector<double>& right)>;

/// Replaces each right-hand side by K^-1 times it. Several ones take less time together than one after the other.
using SolveAll = std::function<void(std::vector<std::vector<double>>& vectors)>;

}  // namespace newton
