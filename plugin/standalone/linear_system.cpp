#include "linear_system.h"

#include "error.h"

namespace standalone {
namespace {

/// A diagonal entry serves as pivot unless it is this much smaller than the largest of its column. The matrix is close
/// to a symmetric quasi-definite one, whose factors exist in any order (Vanderbei 1995), so the order that keeps them
/// sparse wins.
constexpr double pivot_threshold = 1e-3;

}  // namespace

LinearSystem::LinearSystem(Index places) : matrix_(places, places) {
  matrix_.setIdentity();
  factors_.isSymmetric(true);
  factors_.setPivotThreshold(pivot_threshold);
}

void LinearSystem::add(const std::vector<int>& rows, const std::vector<int>& columns, const MatrixXd& tangent) {
  for (std::size_t j = 0; j < columns.size(); ++j) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      matrix_.coeffRef(rows[i], columns[j]) += tangent(static_cast<Index>(i), static_cast<Index>(j));
    }
  }
}

void LinearSystem::factorise(const std::vector<bool>& free) {
  matrix_.makeCompressed();
  Eigen::SparseMatrix<double> constrained = matrix_;
  for (Index column = 0; column < constrained.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(constrained, column); entry; ++entry) {
      const bool counts = free[static_cast<std::size_t>(entry.row())] && free[static_cast<std::size_t>(column)];
      if (!counts) entry.valueRef() = entry.row() == column ? 1.0 : 0.0;
    }
  }
  if (!constrained.coeffs().allFinite()) throw StepFailure("the tangent is not finite: an element has lost its pores");
  if (constrained.nonZeros() != analysed_) factors_.analyzePattern(constrained);
  analysed_ = constrained.nonZeros();
  factors_.factorize(constrained);
  if (factors_.info() != Eigen::Success)
    throw StepFailure("the tangent matrix is singular: " + factors_.lastErrorMessage());
}

VectorXd LinearSystem::solve(const VectorXd& right_hand_side) const {
  VectorXd solution = factors_.solve(right_hand_side);
  if (!solution.allFinite()) throw StepFailure("the solution of the linear system is not finite");
  return solution;
}

}  // namespace standalone
