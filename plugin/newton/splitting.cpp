#include "splitting.h"

#include "indexing/entries.h"

#include <algorithm>
#include <cmath>
#include <functional>

using indexing::at;

namespace newton {
namespace {

/// By how much a sweep has to reduce the change of the one before.
constexpr double least_reduction = 0.5;

std::vector<double> difference(const std::vector<double>& one, const std::vector<double>& other) {
  std::vector<double> result(one.size());
  std::transform(one.begin(), one.end(), other.begin(), result.begin(), std::minus<>());
  return result;
}

/// The length of what D multiplies of a vector.
double length(const MatrixParts& parts, const std::vector<double>& x) {
  double squares = 0;
  for (const MatrixPart* part : parts) squares += part->squares(x);
  return std::sqrt(squares);
}

std::vector<double> product(const MatrixParts& parts, const std::vector<double>& x) {
  std::vector<double> sum(x.size());
  for (const MatrixPart* part : parts) part->add_product(x, sum);
  return sum;
}

}  // namespace

void MatrixPart::add_product(const std::vector<double>& x, std::vector<double>& sum) const {
  for (const MatrixBlock& block : blocks_) {
    for (Eigen::Index i = 0; i < block.values.rows(); ++i) {
      const int row = at(block.rows, i);
      if (row < 0) continue;
      double entry = 0;
      for (Eigen::Index j = 0; j < block.values.cols(); ++j) {
        const int column = at(block.columns, j);
        if (column >= 0) entry += block.values(i, j) * at(x, column);
      }
      at(sum, row) += entry;
    }
  }
}

double MatrixPart::squares(const std::vector<double>& x) const {
  double sum = 0;
  for (const MatrixBlock& block : blocks_) {
    for (const int column : block.columns) {
      if (column >= 0) sum += at(x, column) * at(x, column);
    }
  }
  return sum;
}

bool Splitting::is_last_sweep() const {
  // Of the change, sweeps to come make `reduction`, reduction^2, and so on: the last one leaves the second of these.
  return change_ * reduction_ * reduction_ <= tolerance_ * length(parts_, x_);
}

std::vector<double> Splitting::product(const Solve& solve, MatrixParts parts, const std::vector<double>& right) {
  converges_ = true;
  parts_.clear();
  if (std::all_of(parts.begin(), parts.end(), [](const MatrixPart* part) { return part->empty(); })) return {};
  x_ = solve(right);
  change_ = length(parts, x_);
  if (!std::isfinite(change_)) return {};  // nothing is known of the part: the host sees for itself
  parts_ = std::move(parts);
  std::vector<double> before;  // the product that the present x was solved with
  while (!is_last_sweep()) {
    std::vector<double> made = newton::product(parts_, x_);
    std::vector<double> next = solve(difference(right, made));
    const double reduction = length(parts_, difference(next, x_)) / change_;
    converges_ = reduction <= least_reduction;
    if (!converges_) {
      parts_.clear();
      return reduction < 1 ? made : before;
    }
    x_ = std::move(next);
    before = std::move(made);
    change_ *= reduction;
    reduction_ = reduction;
  }
  return newton::product(parts_, x_);
}

void Splitting::swept(const std::vector<double>& x) {
  const double change = length(parts_, difference(x, x_));
  if (parts_.empty() || !(change_ > 0) || !std::isfinite(change)) return;
  reduction_ = change / change_;
  converges_ = reduction_ <= least_reduction;
  parts_.clear();
}

}  // namespace newton
