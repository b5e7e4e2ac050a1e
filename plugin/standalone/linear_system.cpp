#include "linear_system.h"

#include "error.h"

#include <algorithm>

namespace standalone {
namespace {

/// A diagonal entry serves as pivot unless it is this much smaller than the largest of its column. The matrix is close
/// to a symmetric quasi-definite one, whose factors exist in any order (Vanderbei 1995), so the order that keeps them
/// sparse wins.
constexpr double pivot_threshold = 1e-3;

Index place(const LinearSystem::Matrix& matrix, int row, int column) {
  const int* first = matrix.innerIndexPtr() + matrix.outerIndexPtr()[column];
  const int* last = matrix.innerIndexPtr() + matrix.outerIndexPtr()[column + 1];
  return std::lower_bound(first, last, row) - matrix.innerIndexPtr();
}

std::vector<int> pattern(const LinearSystem::Matrix& matrix) {
  std::vector<int> numbers(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.outerSize() + 1);
  numbers.insert(numbers.end(), matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros());
  return numbers;
}

}  // namespace

LinearSystem::LinearSystem(int free, int size, const std::vector<std::vector<int>>& elements) : bodies_(free, size) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < free; ++i) entries.emplace_back(i, i, 0.0);
  for (const auto& numbers : elements) {
    for (const int column : numbers) {
      for (const int row : numbers) {
        if (row < free) entries.emplace_back(row, column, 0.0);
      }
    }
  }
  bodies_.setFromTriplets(entries.begin(), entries.end());
  for (const auto& numbers : elements) {
    std::vector<Index>& places = places_.emplace_back();
    for (const int column : numbers) {
      for (const int row : numbers) places.push_back(row < free ? place(bodies_, row, column) : -1);
    }
  }
  factors_.isSymmetric(true);
  factors_.setPivotThreshold(pivot_threshold);
}

void LinearSystem::clear() {
  bodies_.coeffs().setZero();
  others_.clear();
}

void LinearSystem::add_element(std::size_t element, const MatrixXd& tangent) {
  const std::vector<Index>& places = places_[element];
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i] >= 0) bodies_.valuePtr()[places[i]] += tangent.data()[i];
  }
}

void LinearSystem::add(const std::vector<int>& rows, const std::vector<int>& columns, const MatrixXd& tangent) {
  for (Index j = 0; j < tangent.cols(); ++j) {
    for (Index i = 0; i < tangent.rows(); ++i) {
      const int row = rows[static_cast<std::size_t>(i)];
      const int column = columns[static_cast<std::size_t>(j)];
      if (row >= 0 && row < bodies_.rows() && column >= 0) others_.emplace_back(row, column, tangent(i, j));
    }
  }
}

void LinearSystem::factorise(const std::vector<bool>& held) {
  Matrix others(bodies_.rows(), bodies_.cols());
  others.setFromTriplets(others_.begin(), others_.end());
  Matrix all = bodies_ + others;
  for (int column = 0; column < all.outerSize(); ++column) {
    const bool fixed = column < all.rows() && held[static_cast<std::size_t>(column)];
    for (Matrix::InnerIterator entry(all, column); entry; ++entry) {
      if (fixed || held[static_cast<std::size_t>(entry.row())]) entry.valueRef() = entry.row() == column ? 1.0 : 0.0;
    }
  }
  matrix_ = all.leftCols(all.rows());
  prescribed_ = all.rightCols(all.cols() - all.rows());
  if (!matrix_.coeffs().allFinite()) throw StepFailure("the tangent is not finite: an element has lost its pores");
  std::vector<int> now = pattern(matrix_);
  if (now != analysed_) {
    factors_.analyzePattern(matrix_);
    analysed_ = std::move(now);
  }
  factors_.factorize(matrix_);
  if (factors_.info() != Eigen::Success)
    throw StepFailure("the tangent matrix is singular: " + factors_.lastErrorMessage());
}

VectorXd LinearSystem::solve(const VectorXd& right_hand_side) const {
  VectorXd solution = factors_.solve(right_hand_side);
  if (!solution.allFinite()) throw StepFailure("the solution of the linear system is not finite");
  return solution;
}

}  // namespace standalone
