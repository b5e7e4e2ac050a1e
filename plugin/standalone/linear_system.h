/// The sparse tangent matrix and its factorisation.
#pragma once

#include "model.h"

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

namespace standalone {

/// Assembles the tangent over all places of nodal values and solves with it. Entries that once came stay in the
/// pattern, and the symbolic analysis is kept while no new ones come.
class LinearSystem {
 public:
  explicit LinearSystem(Index places);

  /// Sets all entries to zero.
  void clear() { matrix_.coeffs().setZero(); }
  void add(const std::vector<int>& rows, const std::vector<int>& columns, const MatrixXd& tangent);

  /// The tangent times a vector.
  VectorXd times(const VectorXd& vector) const { return matrix_ * vector; }
  /// Factors the matrix, with rows and columns of places that are not `free` replaced by those of the identity. Throws
  /// StepFailure where it is singular.
  void factorise(const std::vector<bool>& free);
  VectorXd solve(const VectorXd& right_hand_side) const;

 private:
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> factors_;
  Index analysed_ = 0;  ///< entries of the last symbolic analysis
};

}  // namespace standalone
