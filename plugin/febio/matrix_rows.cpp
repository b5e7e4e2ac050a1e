#include "matrix_rows.h"

#include "contact/base/parallel.h"

#include <FECore/CompactUnSymmMatrix.h>
#include <FECore/FEGlobalMatrix.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

using namespace mixture_contact;

namespace {

/// A column of a block: its equation and its place.
using Column = std::pair<int, Index>;

std::vector<Column> ascending(const std::vector<int>& equations) {
  std::vector<Column> columns;
  columns.reserve(equations.size());
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

/// Finds the places of columns in a row, given those in another one, which are mostly the same. Throws std::logic_error
/// where the row lacks one.
void find_places(const Row& row, const std::vector<Column>& order, int offset, std::vector<int>& places) {
  int place = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const int wanted = order[k].first + offset;
    if (places[k] < row.length && row.columns[places[k]] == wanted) {
      place = places[k];
    } else {
      while (place < row.length && row.columns[place] != wanted) ++place;
      if (place == row.length) throw std::logic_error("an entry of a contact's tangent has no place in the matrix");
      places[k] = place;
    }
  }
}

/// Takes over the rows of a block that `is_own` tells.
template <class IsOwn>
void subtract_rows(CRSSparseMatrix& matrix, const MatrixBlock& block, const std::vector<Column>& order,
                   const IsOwn& is_own) {
  std::vector<int> places(order.size(), 0);
  Row last;  // the next one mostly has the same columns: it is of the same node
  for (std::size_t i = 0; i < block.rows.size(); ++i) {
    if (block.rows[i] < 0 || !is_own(block.rows[i])) continue;
    const Row row = row_of(matrix, block.rows[i]);
    if (!row.has_columns_of(last)) find_places(row, order, matrix.Offset(), places);
    for (std::size_t k = 0; k < order.size(); ++k) {
      row.values[places[k]] -= block.values(static_cast<Index>(i), order[k].second);
    }
    last = row;
  }
}

/// Rows that follow each other and are one thread's: those of several nodes, which mostly lie together in memory.
constexpr int rows_together = 64;

}  // namespace

MatrixRows::MatrixRows(FEGlobalMatrix& matrix) : rows_(dynamic_cast<CRSSparseMatrix*>(matrix.GetSparseMatrixPtr())) {}

void MatrixRows::subtract(const IndexedVector<MatrixBlock>& blocks) const {
  if (blocks.empty()) return;
  IndexedVector<std::vector<Column>> orders(blocks.count());
  in_parallel(blocks.count(), [&](Index n) { orders[n] = ascending(blocks[n].columns); });
  const int threads = thread_count();
  in_parallel<1>(threads, [&](Index thread) {
    const auto is_own = [&](int row) { return row / rows_together % threads == thread; };
    for (Index n = 0; n < blocks.count(); ++n) subtract_rows(*rows_, blocks[n], orders[n], is_own);
  });
}
