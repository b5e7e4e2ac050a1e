#include "border.h"

#include "indexing/entries.h"

#include <Eigen/LU>

#include <algorithm>

using indexing::at;

namespace newton {
namespace {

/// The largest number of columns for which a host solves together. The size is a choice: with more, the time of each
/// hardly falls, and the memory grows.
constexpr std::ptrdiff_t most_together = 16;

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

double product(const std::vector<Condition::Entry>& entries, const Eigen::Ref<const Eigen::VectorXd>& values) {
  double sum = 0;
  for (const Condition::Entry& entry : entries) sum += entry.value * values[entry.equation];
  return sum;
}

double product(const std::vector<Condition::Entry>& entries, const std::vector<double>& values) {
  return product(entries, Eigen::Map<const Eigen::VectorXd>(values.data(), indexing::number_of(values)));
}

Condition given_unknown(int equation, double value) {
  return {equation, {{equation, 1.0}}, {{equation, 1.0}}, 0.0, value};
}

void Border::add_columns(const SolveAll& solve, const std::vector<Condition>& conditions, Eigen::Index size) {
  std::vector<const Condition*> unknown;
  for (const Condition& condition : conditions) {
    if (places_.count(condition.key) == 0) unknown.push_back(&condition);
  }
  for (auto next = unknown.begin(); next != unknown.end();) {
    Eigen::MatrixXd rights = Eigen::MatrixXd::Zero(size, std::min(most_together, unknown.end() - next));
    for (Eigen::Index n = 0; n < rights.cols(); ++n, ++next) {
      for (const Condition::Entry& entry : (*next)->column) rights(entry.equation, n) += entry.value;
      places_[(*next)->key] = {columns_.size(), n};
    }
    columns_.push_back(solve(std::move(rights)));
  }
}

Eigen::MatrixXd::ConstColXpr Border::column(const Condition& condition) const {
  const auto& [matrix, n] = places_.at(condition.key);
  return columns_[matrix].col(n);
}

Eigen::VectorXd Border::unknowns(const SolveAll& solve, const std::vector<Condition>& conditions,
                                 const std::vector<double>& free) {
  add_columns(solve, conditions, indexing::number_of(free));
  const int count = indexing::number_of(conditions);
  Eigen::MatrixXd answers(count, count);
  Eigen::VectorXd values(count);
  for (int i = 0; i < count; ++i) {
    const auto answer = column(at(conditions, i));
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
    Eigen::Map<Eigen::VectorXd>(found.x.data(), indexing::number_of(found.x)) -= z[i] * column(condition);
    found.z[condition.key] = z[i];
  }
  return found;
}

}  // namespace newton
