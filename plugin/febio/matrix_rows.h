/// Dense blocks into a matrix that FEBio stores by rows.
///
/// FEBio bisects the row for every entry of a block, and adds it by an atomic instruction. Columns of a row are
/// ascending: with those of the block in the same order one walk along the row meets all of them.
#pragma once

#include "contact/base/types.h"

#include <vector>

class CRSSparseMatrix;
class FEGlobalMatrix;

class MatrixRows {
 public:
  /// None where FEBio stores this matrix in another way.
  explicit MatrixRows(FEGlobalMatrix& matrix);

  explicit operator bool() const { return rows_ != nullptr; }

  /// Subtracts a block of (rows, columns) from the matrix, whose profile holds these places. Rows and columns with the
  /// equation -1 are left out.
  void subtract(const std::vector<int>& rows, const std::vector<int>& columns,
                const mixture_contact::MatrixXd& block) const;

 private:
  CRSSparseMatrix* rows_;
};
