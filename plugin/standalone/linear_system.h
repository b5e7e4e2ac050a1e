/// The sparse tangent matrix and its factorisation.
#pragma once

#include "model.h"

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

namespace standalone {

/// Assembles the tangent over all places of nodal values and solves with it. The symbolic analysis is kept while the
/// pattern stays the same.
class LinearSystem {
 public:
  using Matrix = Eigen::SparseMatrix<double>;

  explicit LinearSystem(Index places);

  void clear();
  void add(const std::vector<int>& rows, const std::vector<int>& columns, const MatrixXd& tangent);

  /// Product of the last factorised tangent with a vector.
  VectorXd times(const VectorXd& vector) const { return matrix_ * vector; }
  /// Factors the matrix, with rows and columns of places that are not `free` replaced by those of the identity. Throws
  /// StepFailure where it is singular.
  void factorise(const std::vector<bool>& free);
  VectorXd solve(const VectorXd& right_hand_side) const;

 private:
  std::vector<Eigen::Triplet<double>> entries_;
  Matrix matrix_;
  Matrix constrained_;  ///< with the places that are not free left out
  Eigen::SparseLU<Matrix> factors_;
};

}  // namespace standalone
