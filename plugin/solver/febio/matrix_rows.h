/// Addition of dense blocks to a matrix that FEBio stores by rows.
///
/// FEBio bisects the row for every entry of a block, and adds it by an atomic instruction. Columns of a row are
/// ascending: with those of the block in the same order one walk along the row meets all of them.
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

class MatrixRows {
 public:
  /// Null if FEBio stores this matrix in another way.
  explicit MatrixRows(FEGlobalMatrix& matrix);

  explicit operator bool() const { return rows_ != nullptr; }

  /// Subtracts blocks from the matrix, whose profile holds their places. Threads share the rows of the matrix: each row
  /// takes its entries in the order of the blocks, so that sums do not depend on the number of threads.
  void subtract(const mixture_contact::IndexedVector<MatrixBlock>& blocks) const;
  /// Adds multiples of the rows of unknowns to another row so that it has no entries in their columns. Returns none and
  /// changes nothing if the row lacks an entry of theirs, if their rows do not determine them, or if rounding would
  /// destroy the diagonal of the row.
  std::optional<RowOperation> eliminate(const std::vector<int>& unknowns, int row) const;
  /// Subtracts the rows of others from a row again.
  void undo(const RowOperation& operation) const;
  /// Backward error of a solution: the largest relative change of a row of the matrix, or of its right-hand side, that
  /// makes the solution exact (Oettli and Prager 1964, Numerische Mathematik 6, 405-409).
  double backward_error(const std::vector<double>& solution, const std::vector<double>& right) const;

 private:
  CRSSparseMatrix* rows_;
};

}  // namespace newton
