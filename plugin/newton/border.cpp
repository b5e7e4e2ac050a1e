#include "border.h"

#include "indexing/entries.h"

#include <Eigen/LU>

using indexing::at;

namespace newton {
namespace {

double product(const std::vector<Condition::Entry>& entries, const std::vector<double>& values) {
  double sum = 0;
  for (const Condition::Entry& entry : entries) sum += entry.value * at(values, entry.equation);
  return sum;
}

void add(double factor, const std::vector<Condition::Entry>& entries, std::vector<double>& values) {
  for (const Condition::Entry& entry : entries) at(values, entry.equation) += factor * entry.value;
}

/// The solution of a small system, whose rows and columns may be in units of their own. Empty where it is singular.
Eigen::VectorXd solved(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  const auto scale_of = [](double largest) { return largest > 0 ? 1 / largest : 1; };
  const Eigen::VectorXd rows = matrix.cwiseAbs().rowwise().maxCoeff().unaryExpr(scale_of);
  const Eigen::MatrixXd scaled = rows.asDiagonal() * matrix;
  const Eigen::VectorXd columns = scaled.cwiseAbs().colwise().maxCoeff().transpose().unaryExpr(scale_of);
  const Eigen::FullPivLU<Eigen::MatrixXd> factors(scaled * columns.asDiagonal());
  if (!factors.isInvertible()) return {};
  return columns.cwiseProduct(factors.solve(rows.cwiseProduct(right)));
}

}  // namespace

Condition zero_unknown(int equation) { return {equation, {{equation, 1.0}}, {{equation, 1.0}}, 0.0}; }

const std::vector<double>& Border::column(const Solve& solve, const Condition& condition, std::size_t size) {
  const auto known = columns_.find(condition.key);
  if (known != columns_.end()) return known->second;
  std::vector<double> right(size);
  add(1, condition.column, right);
  return columns_[condition.key] = solve(right);
}

bool Border::hold(const Solve& solve, const std::vector<Condition>& conditions, std::vector<double>& right) {
  if (conditions.empty()) return true;
  const int count = indexing::number_of(conditions);
  const std::vector<double> free = solve(right);
  Eigen::MatrixXd answers(count, count);
  Eigen::VectorXd values(count);
  for (int i = 0; i < count; ++i) {
    const std::vector<double>& answer = column(solve, at(conditions, i), right.size());
    for (int k = 0; k < count; ++k) answers(k, i) = product(at(conditions, k).row, answer);
    answers(i, i) -= at(conditions, i).diagonal;
    values[i] = product(at(conditions, i).row, free);
  }
  const Eigen::VectorXd z = solved(answers, values);
  if (z.size() == 0) return false;
  for (int i = 0; i < count; ++i) add(-z[i], at(conditions, i).column, right);
  return true;
}

}  // namespace newton
