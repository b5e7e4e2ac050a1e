/// Addition of dense blocks to a matrix that FEBio stores by rows.
///
/// FEBio searches the row by bisection for every entry of a block, and adds the entry by an atomic operation. The
/// columns of a row are ascending; if the columns of the block are sorted as well, a single pass along the row reaches
/// all entries.
#pragma once

#include "contact/base/indexed_vector.h"
#include "solver/row_operations.h"
#include "solver/splitting.h"

#include <optional>
#include <utility>
#include <vector>

class CRSSparseMatrix;
class FEGlobalMatrix;

namespace newton {

/// Direct access to the rows of FEBio's matrix.
class MatrixRows {
 public:
  /// Evaluates to false if FEBio does not store this matrix by rows.
  explicit MatrixRows(FEGlobalMatrix& matrix);

  explicit operator bool() const { return rows_ != nullptr; }

  /// Subtracts blocks from the matrix, whose profile has to contain all their entries. Threads share the rows of the
  /// matrix. Each row adds its entries in the order of the blocks; sums therefore do not depend on the number of
  /// threads.
  void subtract(const mixture_contact::IndexedVector<MatrixBlock>& blocks) const;
  /// Adds multiples of the rows of `unknowns` to `row` such that it has no entries in their columns. Returns the
  /// operation. Returns nothing and changes nothing if the row's profile lacks a column of theirs, if their rows do not
  /// determine the unknowns, or if rounding would destroy the diagonal of the row.
  std::optional<RowOperation> eliminate(const std::vector<int>& unknowns, int row) const;
  /// Reverses a row operation.
  void undo(const RowOperation& operation) const;
  /// Backward error of a solution: the smallest relative change of a row of the matrix and its right-hand side for
  /// which the solution would be exact, the largest one of all rows (Oettli and Prager 1964, Numerische Mathematik 6,
  /// 405-409).
  double backward_error(const std::vector<double>& solution, const std::vector<double>& right) const;

 private:
  CRSSparseMatrix* rows_;
};

}  // namespace newton
