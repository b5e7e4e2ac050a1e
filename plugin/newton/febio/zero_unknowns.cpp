#include "zero_unknowns.h"

#include "indexing/entries.h"

#include <FECore/LinearSolver.h>

#include <Eigen/LU>

namespace newton {
namespace {

std::vector<double> solution(LinearSolver& solver, std::vector<double> right) {
  std::vector<double> found(right.size());
  solver.BackSolve(found, right);
  return found;
}

}  // namespace

const std::vector<double>& ZeroUnknowns::column(LinearSolver& solver, int equation, std::size_t size) {
  const auto known = columns_.find(equation);
  if (known != columns_.end()) return known->second;
  std::vector<double> unit(size);
  indexing::at(unit, equation) = 1;
  return columns_[equation] = solution(solver, std::move(unit));
}

bool ZeroUnknowns::hold(LinearSolver& solver, std::vector<double>& right, const std::vector<int>& equations) {
  if (equations.empty()) return true;
  const int count = indexing::number_of(equations);
  const std::vector<double> free = solution(solver, right);
  Eigen::MatrixXd answers(count, count);
  Eigen::VectorXd values(count);
  for (int i = 0; i < count; ++i) {
    const std::vector<double>& answer = column(solver, indexing::at(equations, i), right.size());
    for (int k = 0; k < count; ++k) answers(k, i) = indexing::at(answer, indexing::at(equations, k));
    values[i] = indexing::at(free, indexing::at(equations, i));
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> factors(answers);
  if (!factors.isInvertible()) return false;
  const Eigen::VectorXd added = factors.solve(-values);
  for (int i = 0; i < count; ++i) indexing::at(right, indexing::at(equations, i)) += added[i];
  return true;
}

}  // namespace newton
