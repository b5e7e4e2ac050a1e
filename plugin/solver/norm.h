/// Norms and multiples of vectors with one entry per equation.
#pragma once

#include <cmath>
#include <numeric>
#include <vector>

namespace newton {

inline double norm(const std::vector<double>& vector) {
  return std::sqrt(std::inner_product(vector.begin(), vector.end(), vector.begin(), 0.0));
}

inline std::vector<double> scaled(std::vector<double> vector, double factor) {
  for (double& entry : vector) entry *= factor;
  return vector;
}

}  // namespace newton
