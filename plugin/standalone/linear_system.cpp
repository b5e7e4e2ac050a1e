#include "linear_system.h"

#include "error.h"

#include <algorithm>
#include <utility>

namespace standalone {
namespace {

/// A diagonal entry is accepted as a pivot if it is at least this fraction of the largest entry in its column. The
/// matrix is almost symmetric and quasi-definite. Such a matrix has factors for any order of pivots (Vanderbei 1995),
/// so that the order with the sparsest factors is preferred.
constexpr double pivot_threshold = 1e-3;

bool have_same_pattern(const LinearSystem::Matrix& one, const LinearSystem::Matrix& two) {
  return one.nonZeros() == two.nonZeros() &&
         std::equal(one.outerIndexPtr(), one.outerIndexPtr() + one.outerSize(), two.outerIndexPtr()) &&
         std::equal(one.innerIndexPtr(), one.innerIndexPtr() + one.nonZeros(), two.innerIndexPtr());
}

}  // namespace

LinearSystem::LinearSystem(Index places) : matrix_(places, places), constrained_(places, places) {
  factors_.isSymmetric(true);
  factors_.setPivotThreshold(pivot_threshold);
}

void LinearSystem::clear() {
  entries_.clear();
  for (int i = 0; i < matrix_.rows(); ++i) entries_.emplace_back(i, i, 0.0);
}

void LinearSystem::add(const std::vector<int>& rows, const std::vector<int>& columns, const MatrixXd& tangent) {
  for (std::size_t j = 0; j < columns.size(); ++j) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      entries_.emplace_back(rows[i], columns[j], tangent(static_cast<Index>(i), static_cast<Index>(j)));
    }
  }
}

void LinearSystem::factorise(const std::vector<bool>& free) {
  matrix_.setFromTriplets(entries_.begin(), entries_.end());
  const Matrix last = std::exchange(constrained_, matrix_);
  for (Index column = 0; column < constrained_.outerSize(); ++column) {
    for (Matrix::InnerIterator entry(constrained_, column); entry; ++entry) {
      const bool counts = at(free, entry.row()) && at(free, column);
      if (!counts) entry.valueRef() = entry.row() == column ? 1.0 : 0.0;
    }
  }
  if (!constrained_.coeffs().allFinite()) throw StepFailure("the tangent is not finite: an element has lost its pores");
  if (!have_same_pattern(constrained_, last)) factors_.analyzePattern(constrained_);
  factors_.factorize(constrained_);
  if (factors_.info() != Eigen::Success)
    throw StepFailure("the tangent matrix is singular: " + factors_.lastErrorMessage());
}

VectorXd LinearSystem::solve(const VectorXd& right_hand_side) const {
  VectorXd solution = factors_.solve(right_hand_side);
  if (!solution.allFinite()) throw StepFailure("the solution of the linear system is not finite");
  return solution;
}

}  // namespace standalone
