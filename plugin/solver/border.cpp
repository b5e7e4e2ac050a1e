#include "border.h"

#include "indexing/entries.h"

#include <Eigen/LU>

#include <algorithm>
#include <limits>
#include <utility>

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

double product(const std::vector<Condition::Entry>& entries, const std::vector<double>& values) {
  double sum = 0;
  for (const Condition::Entry& entry : entries) sum += entry.value * at(values, entry.equation);
  return sum;
}

Condition given_unknown(int equation, double value) {
  return {equation, {{equation, 1.0}}, {{equation, 1.0}}, 0.0, value};
}

void Border::begin(Eigen::Index size) {
  if (!position_.empty()) return;
  position_.assign(indexing::entries(size), -1);
  for (const int equation : list_kept_()) {
    if (equation >= 0) at(position_, equation) = 0;
  }
  for (int equation = 0; equation < size; ++equation) {
    if (at(position_, equation) < 0) continue;
    at(position_, equation) = indexing::number_of(kept_);
    kept_.push_back(equation);
  }
}

bool Border::keeps_rows(const std::vector<Condition>& conditions) const {
  return std::all_of(conditions.begin(), conditions.end(), [&](const Condition& condition) {
    return std::all_of(condition.row.begin(), condition.row.end(),
                       [&](const Condition::Entry& entry) { return at(position_, entry.equation) >= 0; });
  });
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
    columns_.emplace_back(solve(std::move(rights))(kept_, Eigen::all));
  }
}

Eigen::MatrixXd::ConstColXpr Border::column(const Condition& condition) const {
  const auto& [matrix, n] = places_.at(condition.key);
  return columns_[matrix].col(n);
}

Eigen::VectorXd Border::unknowns(const SolveAll& solve, const std::vector<Condition>& conditions,
                                 const std::vector<double>& free) {
  begin(indexing::number_of(free));
  if (!keeps_rows(conditions)) return {};
  add_columns(solve, conditions, indexing::number_of(free));
  const auto product_with = [&](const std::vector<Condition::Entry>& row, const auto& values) {
    double sum = 0;
    for (const Condition::Entry& entry : row) sum += entry.value * values[at(position_, entry.equation)];
    return sum;
  };
  const int count = indexing::number_of(conditions);
  Eigen::MatrixXd answers(count, count);
  Eigen::VectorXd values(count);
  for (int i = 0; i < count; ++i) {
    const auto answer = column(at(conditions, i));
    for (int k = 0; k < count; ++k) answers(k, i) = product_with(at(conditions, k).row, answer);
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

std::optional<Answer> Border::answer(const SolveAll& solve, const std::vector<Condition>& conditions,
                                     const std::vector<double>& free) {
  if (conditions.empty()) return Answer{free, {}};
  const Eigen::VectorXd z = unknowns(solve, conditions, free);
  if (z.size() == 0) return std::nullopt;
  Eigen::VectorXd x = as_vector(free)(kept_);
  std::map<int, double> by_key;
  for (int i = 0; i < z.size(); ++i) {
    x -= z[i] * column(at(conditions, i));
    by_key[at(conditions, i).key] = z[i];
  }
  Answer found{std::vector<double>(free.size(), std::numeric_limits<double>::quiet_NaN()), std::move(by_key)};
  for (int n = 0; n < x.size(); ++n) at(found.x, at(kept_, n)) = x[n];
  return found;
}

}  // namespace newton
