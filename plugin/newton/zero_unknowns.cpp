#include "zero_unknowns.h"

#include "indexing/entries.h"

#include <Eigen/LU>

using indexing::at;

namespace newton {

const std::vector<double>& ZeroUnknowns::column(const Solve& solve, int equation, std::size_t size) {
  const auto known = columns_.find(equation);
  if (known != columns_.end()) return known->second;
  std::vector<double> unit(size);
  at(unit, equation) = 1;
  return columns_[equation] = solve(unit);
}

bool ZeroUnknowns::hold(const Solve& solve, const std::vector<int>& equations, std::vector<double>& right) {
  if (equations.empty()) return true;
  const int count = indexing::number_of(equations);
  const std::vector<double> free = solve(right);
  Eigen::MatrixXd answers(count, count);
  Eigen::VectorXd values(count);
  for (int i = 0; i < count; ++i) {
    const std::vector<double>& answer = column(solve, at(equations, i), right.size());
    for (int k = 0; k < count; ++k) answers(k, i) = at(answer, at(equations, k));
    values[i] = at(free, at(equations, i));
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> factors(answers);
  if (!factors.isInvertible()) return false;
  const Eigen::VectorXd added = factors.solve(-values);
  for (int i = 0; i < count; ++i) at(right, at(equations, i)) += added[i];
  return true;
}

}  // namespace newton
