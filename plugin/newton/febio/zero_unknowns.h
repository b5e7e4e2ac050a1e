/// Unknowns of a factorised matrix that the right-hand side holds at zero.
///
/// The solution of K x = b + E a, where E are the columns of the unit matrix of some unknowns, has these at zero with
/// (E^T K^-1 E) a = -E^T K^-1 b: as if their rows had been taken out of K, and their columns. It costs a back
/// substitution for each unknown once, and one for each right-hand side.
#pragma once

#include <map>
#include <vector>

class LinearSolver;

namespace newton {

class ZeroUnknowns {
 public:
  /// A matrix has been factorised.
  void forget() { columns_.clear(); }
  /// Adds to the right-hand side what holds the unknowns of these equations at zero. Returns whether that is possible:
  /// not where the matrix without them is singular.
  bool hold(LinearSolver& solver, std::vector<double>& right, const std::vector<int>& equations);

 private:
  /// K^-1 e
  const std::vector<double>& column(LinearSolver& solver, int equation, std::size_t size);

  std::map<int, std::vector<double>> columns_;
};

}  // namespace newton
