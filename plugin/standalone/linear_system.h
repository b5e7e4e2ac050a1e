/// The sparse tangent matrix and its factorisation.
#pragma once

#include "model.h"

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

namespace standalone {

/// Assembles the tangent, rows of the free equations and columns of the prescribed values as well, and solves with it.
/// The place of each element's entries in the matrix is found once; contact adds entries wherever facets meet. The
/// symbolic analysis is kept while the pattern stays the same.
class LinearSystem {
 public:
  using Matrix = Eigen::SparseMatrix<double>;

  /// `elements`: the numbers of each element's entries, those below `free` of equations to solve, below `size` all.
  LinearSystem(int free, int size, const std::vector<std::vector<int>>& elements);

  void clear();
  void add_element(std::size_t element, const MatrixXd& tangent);
  /// Negative numbers are left out.
  void add(const std::vector<int>& rows, const std::vector<int>& columns, const MatrixXd& tangent);

  /// Puts the matrix together with rows and columns of `held` equations replaced by those of the identity, and factors
  /// it. Throws StepFailure where it is singular.
  void factorise(const std::vector<bool>& held);
  /// What changes of the prescribed values do to the equations that are not held.
  VectorXd effect(const VectorXd& changes) const { return prescribed_ * changes; }
  VectorXd solve(const VectorXd& right_hand_side) const;

  Index entries() const { return matrix_.nonZeros(); }

 private:
  std::vector<std::vector<Index>> places_;  ///< of the values of bodies_, per element and entry; -1: none
  Matrix bodies_;
  std::vector<Eigen::Triplet<double>> others_;
  Matrix matrix_, prescribed_;  ///< columns of the free equations and of the prescribed values
  Eigen::SparseLU<Matrix> factors_;
  std::vector<int> analysed_;  ///< pattern of the last symbolic analysis
};

}  // namespace standalone
