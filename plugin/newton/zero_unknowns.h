/// Unknowns of a factorised matrix that the right-hand side holds at zero.
///
/// The solution of K x = b + E a, where E are the columns of the unit matrix of some unknowns, has these at zero with
/// (E^T K^-1 E) a = -E^T K^-1 b: as if their rows and columns had been taken out of K. It costs a back substitution for
/// each unknown once, and one for each right-hand side.
#pragma once

#include <functional>
#include <map>
#include <vector>

namespace newton {

class ZeroUnknowns {
 public:
  /// K^-1 times a right-hand side.
  using Solve = std::function<std::vector<double>(const std::vector<double>& right)>;

  /// Another matrix has been factorised.
  void forget() { columns_.clear(); }
  /// Whether any are held at zero with it.
  bool are_held() const { return !columns_.empty(); }
  /// Adds to a right-hand side what holds the unknowns of these equations at zero. Returns false, and adds nothing,
  /// where the matrix without them is singular.
  bool hold(const Solve& solve, const std::vector<int>& equations, std::vector<double>& right);

 private:
  /// K^-1 e of an equation.
  const std::vector<double>& column(const Solve& solve, int equation, std::size_t size);

  std::map<int, std::vector<double>> columns_;
};

}  // namespace newton
