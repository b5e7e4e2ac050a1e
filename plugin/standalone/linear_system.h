/// The sparse tangent matrix and its factorisation.
#pragma once

#include "model.h"

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

namespace standalone {

/// Assembles the tangent of all nodal values and solves with it. The symbolic analysis is reused while the sparsity
/// pattern is the same.
class LinearSystem {
 public:
  using Matrix = Eigen::SparseMatrix<double>;

  /// `places`: number of nodal values.
  explicit LinearSystem(Index places);

  /// Removes all entries.
  void clear();
  /// Adds a block with these rows and columns.
  void add(const std::vector<int>& rows, const std::vector<int>& columns, const MatrixXd& tangent);

  /// Product of the tangent that was factorised last with a vector.
  VectorXd times(const VectorXd& vector) const { return matrix_ * vector; }
  /// Factorises the matrix after replacing the rows and columns of nodal values that are not `free` by those of the
  /// identity. Throws StepFailure if it is singular.
  void factorise(const std::vector<bool>& free);
  /// Solves with the last factorisation.
  VectorXd solve(const VectorXd& right_hand_side) const;

 private:
  std::vector<Eigen::Triplet<double>> entries_;
  Matrix matrix_;
  Matrix constrained_;  ///< matrix with identity rows and columns for values that are not free
  Eigen::SparseLU<Matrix> factors_;
};

}  // namespace standalone
