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

/// A row of the matrix.
struct Row {
  const int* columns = nullptr;  ///< ascending
  int length = 0;
  double* values = nullptr;

  bool has_columns_of(const Row& other) const {
    return length == other.length && std::equal(columns, columns + length, other.columns);
  }
};

Row row_of(CRSSparseMatrix& matrix, int equation) {
  const int begin = matrix.Pointers()[equation] - matrix.Offset();
  const int end = matrix.Pointers()[equation + 1] - matrix.Offset();
  return {matrix.Indices() + begin, end - begin, matrix.Values() + begin};
}

/// Rows of a block one after the other that have the same columns, as those of one node mostly do: blocks are stored by
/// columns.
using Band = std::vector<Row>;

/// The band that begins with a row of a block, given the equations of its rows; none where that row has no equation.
Band band_from(CRSSparseMatrix& matrix, const std::vector<int>& equations, std::size_t first) {
  Band band;
  for (std::size_t i = first; i < equations.size() && equations[i] >= 0; ++i) {
    const Row row = row_of(matrix, equations[i]);
    if (!band.empty() && !row.has_columns_of(band.front())) break;
    band.push_back(row);
  }
  return band;
}

/// Finds the places of columns in a row, given those in another one, which are mostly the same.
void find_places(const Row& row, const std::vector<Column>& order, int offset, std::vector<int>& places) {
  int place = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const int wanted = order[k].first + offset;
    if (places[k] < row.length && row.columns[places[k]] == wanted) {
      place = places[k];
    } else {
      while (row.columns[place] != wanted) ++place;
      places[k] = place;
    }
  }
}

}  // namespace

MatrixRows::MatrixRows(FEGlobalMatrix& matrix) : rows_(dynamic_cast<CRSSparseMatrix*>(matrix.GetSparseMatrixPtr())) {}

void MatrixRows::subtract(const std::vector<int>& rows, const std::vector<int>& columns, const MatrixXd& block) const {
  const std::vector<Column> order = ascending(columns);
  std::vector<int> places(order.size(), 0);
  Band band;
  for (std::size_t first = 0; first < rows.size(); first += std::max<std::size_t>(1, band.size())) {
    band = band_from(*rows_, rows, first);
    if (band.empty()) continue;
    find_places(band.front(), order, rows_->Offset(), places);
    for (std::size_t k = 0; k < order.size(); ++k) {
      for (std::size_t i = 0; i < band.size(); ++i)
        band[i].values[places[k]] -= block(static_cast<Index>(first + i), order[k].second);
    }
  }
}
