#include "matrix_rows.h"

#include <FECore/CompactUnSymmMatrix.h>
#include <FECore/FEGlobalMatrix.h>

#include <algorithm>
#include <utility>

using namespace mixture_contact;

namespace {

/// A column of a block: its equation and its place.
using Column = std::pair<int, Index>;

std::vector<Column> ascending(const std::vector<int>& equations) {
  std::vector<Column> columns;
  for (std::size_t j = 0; j < equations.size(); ++j) {
    if (equations[j] >= 0) columns.emplace_back(equations[j], static_cast<Index>(j));
  }
  std::sort(columns.begin(), columns.end());
  return columns;
}

}  // namespace

MatrixRows::MatrixRows(FEGlobalMatrix& matrix) : rows_(dynamic_cast<CRSSparseMatrix*>(matrix.GetSparseMatrixPtr())) {}

void MatrixRows::subtract(const std::vector<int>& rows, const std::vector<int>& columns, const MatrixXd& block) const {
  const std::vector<Column> order = ascending(columns);
  const int first = rows_->Offset();
  // Places of the columns in the last row. Those in the next one are mostly the same: it is of the same node.
  std::vector<int> places(order.size(), 0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i] < 0) continue;
    const int begin = rows_->Pointers()[rows[i]] - first;
    const int length = rows_->Pointers()[rows[i] + 1] - first - begin;
    const int* const indices = rows_->Indices() + begin;
    double* const values = rows_->Values() + begin;
    int place = 0;
    for (std::size_t k = 0; k < order.size(); ++k) {
      const auto& [equation, j] = order[k];
      const int wanted = equation + first;
      if (places[k] < length && indices[places[k]] == wanted) {
        place = places[k];
      } else {
        while (indices[place] != wanted) ++place;
        places[k] = place;
      }
      values[place] -= block(static_cast<Index>(i), j);
    }
  }
}
