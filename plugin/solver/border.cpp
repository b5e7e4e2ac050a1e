#include "border.h"

#include "indexing/entries.h"

#include <Eigen/LU>

using indexing::at;

namespace newton {
namespace {

/// The largest number of columns for which a host solves together. The size is a choice: with more, the time of each
/// hardly falls, and the memory grows.
constexpr std::size_t most_together = 32;

void add(double factor, const std::vector<Condition::Entry>& entries, std::vector<double>& values) {
  for (const Condition::Entry& entry : entries) at(values, entry.equation) += factor * entry.value;
}

/// The solution of a small system whose rows and columns may have different units; empty if it is singular.
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

double product(const std::vector<Condition::Entry>& entries, const std::vector<double>& values) {
  double sum = 0;
  for (const Condition::Entry& entry : entries) sum += entry.value * at(values, entry.equation);
  return sum;
}

Condition given_unknown(int equation, double value) {
  return {equation, {{equation, 1.0}}, {{equation, 1.0}}, 0.0, value};
}

void Border::add_columns(const SolveAll& solve, const std::vector<Condition>& conditions, std::size_t size) {
  std::vector<int> keys;
  std::vector<std::vector<double>> vectors;
  const auto solve_for_keys = [&] {
    if (!keys.empty()) solve(vectors);
    for (std::size_t i = 0; i < keys.size(); ++i) columns_[keys[i]] = std::move(vectors[i]);
    keys.clear();
    vectors.clear();
  };
  for (const Condition& condition : conditions) {
    if (columns_.count(condition.key) > 0) continue;
    keys.push_back(condition.key);
    add(1, condition.column, vectors.emplace_back(size));
    if (keys.size() == most_together) solve_for_keys();
  }
  solve_for_keys();
}

Eigen::VectorXd Border::unknowns(const SolveAll& solve, const std::vector<Condition>& conditions,
                                 const std::vector<double>& free) {
  add_columns(solve, conditions, free.size());
  const int count = indexing::number_of(conditions);
  Eigen::MatrixXd answers(count, count);
  Eigen::VectorXd values(count);
  for (int i = 0; i < count; ++i) {
    const std::vector<double>& answer = columns_.at(at(conditions, i).key);
    for (int k = 0; k < count; ++k) answers(k, i) = product(at(conditions, k).row, answer);
    answers(i, i) -= at(conditions, i).diagonal;
    values[i] = product(at(conditions, i).row, free) - at(conditions, i).value;
  }
  return solved(answers, values);
}

bool Border::hold(const SolveAll& solve, const std::vector<Condition>& conditions, const std::vector<double>& free,
                  std::vector<double>& right) {
  if (conditions.empty()) return true;
  const Eigen::VectorXd z = unknowns(solve, conditions, free);
  for (int i = 0; i < z.size(); ++i) add(-z[i], at(conditions, i).column, right);
  has_held_ = has_held_ || z.size() > 0;
  return z.size() > 0;
}

std::vector<double> Border::solution(const SolveAll& solve, const std::vector<Condition>& conditions,
                                     std::vector<double> free) {
  if (conditions.empty()) return free;
  std::optional<Answer> found = answer(solve, conditions, free);
  if (found) free = std::move(found->x);
  return free;
}

std::optional<Answer> Border::answer(const SolveAll& solve, const std::vector<Condition>& conditions,
                                     std::vector<double> free) {
  Answer found{std::move(free), {}};
  if (conditions.empty()) return found;
  const Eigen::VectorXd z = unknowns(solve, conditions, found.x);
  if (z.size() == 0) return std::nullopt;
  for (int i = 0; i < z.size(); ++i) {
    const Condition& condition = at(conditions, i);
    const std::vector<double>& column = columns_.at(condition.key);
    for (std::size_t n = 0; n < found.x.size(); ++n) at(found.x, n) -= z[i] * at(column, n);
    found.z[condition.key] = z[i];
  }
  return found;
}

}  // namespace newton
