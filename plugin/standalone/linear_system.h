/// The sparse tangent matrix and its factorisation.
#pragma once

#include "equations.h"

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

namespace standalone {

/// Assembles the tangent over the free equations and solves with it. The place of each element's entries in the matrix
/// is found once; contact adds entries wherever facets meet. The symbolic analysis is kept while the pattern stays the
/// same.
class LinearSystem {
 public:
  using Matrix = Eigen::SparseMatrix<double>;

  /// `element_equations`: the equations of each element's entries, negative for none.
  LinearSystem(int equations, std::vector<std::vector<int>> element_equations);

  void clear();
  void add_element(std::size_t element, const MatrixXd& tangent);
  void add(const std::vector<int>& rows, const std::vector<int>& columns, const MatrixXd& tangent);

  /// Puts the matrix together with rows and columns of `held` equations replaced by those of the identity, and factors
  /// it. Throws StepFailure where it is singular.
  void factorise(const std::vector<bool>& held);
  VectorXd solve(const VectorXd& right_hand_side) const;

  Index entries() const { return matrix_.nonZeros(); }

 private:
  std::vector<std::vector<int>> element_equations_;
  std::vector<std::vector<Index>>
      places_;  ///< per element and entry (column by column): index into the values of bodies_
  Matrix bodies_;
  std::vector<Eigen::Triplet<double>> others_;
  Matrix matrix_;
  Eigen::SparseLU<Matrix> factors_;
  std::vector<int> analysed_;  ///< pattern of the last symbolic analysis
};

}  // namespace standalone
