#include "matrix_rows.h"

#include "contact/base/parallel.h"

#include <FECore/CompactUnSymmMatrix.h>
#include <FECore/FEGlobalMatrix.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

using namespace mixture_contact;

namespace newton {

namespace {

/// A column of a block: its equation and its number in the block.
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

/// A row of FEBio's matrix.
struct Row {
  const int* columns = nullptr;  ///< column indices, ascending
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

/// Sets `places` to the positions of columns in a row. On entry, it contains their positions in another row, which are
/// often the same. Throws std::logic_error if the row has no entry for a column.
void find_places(const Row& row, const std::vector<Column>& order, int offset, std::vector<int>& places) {
  int place = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const int wanted = order[k].first + offset;
    if (places[k] < row.length && row.columns[places[k]] == wanted) {
      place = places[k];
    } else {
      place = static_cast<int>(std::lower_bound(row.columns + place, row.columns + row.length, wanted) - row.columns);
      if (place == row.length || row.columns[place] != wanted)
        throw std::logic_error("an entry of a contact's tangent is not in the matrix profile");
      places[k] = place;
    }
  }
}

/// Subtracts the rows of a block for which `is_own` is true.
template <class IsOwn>
void subtract_rows(CRSSparseMatrix& matrix, const MatrixBlock& block, const std::vector<Column>& order,
                   const IsOwn& is_own) {
  std::vector<int> places(order.size(), 0);
  Row last;  // the next row usually has the same columns, because it belongs to the same node
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

bool has_places_for(const Row& row, const Row& other) {
  return std::includes(row.columns, row.columns + row.length, other.columns, other.columns + other.length);
}

void add(double factor, const Row& other, const Row& row) {
  int place = 0;
  for (int k = 0; k < other.length; ++k) {
    while (row.columns[place] != other.columns[k]) ++place;
    row.values[place] += factor * other.values[k];
  }
}

/// The smallest reciprocal condition number of the rows of unknowns. Below it, half of the digits are lost, and the
/// rows do not determine the unknowns.
constexpr double least_condition = 1e-8;

/// The factors on the rows of unknowns such that their sum with `row` has no entries in the columns of the unknowns;
/// empty if the rows do not determine the unknowns.
VectorXd eliminating(CRSSparseMatrix& matrix, const std::vector<int>& unknowns, int row) {
  const Index count = count_of(unknowns);
  MatrixXd own(count, count);  // transposed block of the unknowns
  VectorXd entries(count);
  for (Index j = 0; j < count; ++j) {
    const int column = mixture_contact::at(unknowns, j);
    for (Index i = 0; i < count; ++i) own(j, i) = matrix.get(mixture_contact::at(unknowns, i), column);
    entries[j] = -matrix.get(row, column);
  }
  // The rows are scaled, because displacements, pressures and concentrations have different units.
  const auto scale_of = [](double diagonal) { return diagonal != 0 ? 1 / std::sqrt(std::abs(diagonal)) : 1; };
  const VectorXd scales = own.diagonal().unaryExpr(scale_of);
  const Eigen::PartialPivLU<MatrixXd> factors(scales.asDiagonal() * own * scales.asDiagonal());
  if (!(factors.rcond() > least_condition)) return {};
  return scales.cwiseProduct(factors.solve(scales.cwiseProduct(entries)));
}

/// The largest growth of the diagonal of a row. The original diagonal is then known to this factor times the rounding
/// error, 2e-11, and so is the load.
constexpr double most_growth = 1e5;

/// True if the added rows are so large that the diagonal of the row would be lost in rounding.
bool hides_diagonal(CRSSparseMatrix& matrix, const RowOperation& operation) {
  double taken = 0;
  for (const RowOperation::Term& term : operation.terms) taken += term.factor * matrix.get(term.row, operation.row);
  return !(std::abs(taken) <= most_growth * std::abs(matrix.get(operation.row, operation.row)));
}

/// Adds the terms of an operation to its row (`sign` 1), or subtracts them (-1).
void add_terms(CRSSparseMatrix& matrix, const RowOperation& operation, double sign) {
  for (const RowOperation::Term& term : operation.terms)
    add(sign * term.factor, row_of(matrix, term.row), row_of(matrix, operation.row));
}

/// The error of a row for a solution, relative to the sum of the absolute values of its terms.
double error_of(const Row& row, int offset, const std::vector<double>& solution, double right) {
  double left = -right;
  double sizes = std::abs(left);
  for (int k = 0; k < row.length; ++k) {
    const double product = row.values[k] * mixture_contact::at(solution, row.columns[k] - offset);
    left += product;
    sizes += std::abs(product);
  }
  return sizes > 0 ? std::abs(left) / sizes : 0;
}

/// Number of successive rows that one thread processes: the rows of several nodes, which are mostly adjacent in memory.
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

std::optional<RowOperation> MatrixRows::eliminate(const std::vector<int>& unknowns, int row) const {
  const Row target = row_of(*rows_, row);
  const bool has_places = !unknowns.empty() && std::all_of(unknowns.begin(), unknowns.end(), [&](int unknown) {
    return has_places_for(target, row_of(*rows_, unknown));
  });
  if (!has_places) return std::nullopt;
  const VectorXd factors = eliminating(*rows_, unknowns, row);
  RowOperation operation{row, {}};
  for (Index i = 0; i < factors.size(); ++i) operation.terms.push_back({mixture_contact::at(unknowns, i), factors[i]});
  if (operation.terms.empty() || hides_diagonal(*rows_, operation)) return std::nullopt;
  add_terms(*rows_, operation, 1);
  return operation;
}

void MatrixRows::undo(const RowOperation& operation) const { add_terms(*rows_, operation, -1); }

double MatrixRows::backward_error(const std::vector<double>& solution, const std::vector<double>& right) const {
  const int rows = rows_->Rows();
  IndexedVector<double> largest(rows / rows_together + 1, 0.0);
  in_parallel<1>(largest.count(), [&](Index n) {
    const int first = indexing::as_int(n) * rows_together;
    for (int i = first; i < std::min(first + rows_together, rows); ++i)
      largest[n] = std::max(largest[n], error_of(row_of(*rows_, i), rows_->Offset(), solution, indexing::at(right, i)));
  });
  return *std::max_element(largest.begin(), largest.end());
}

}  // namespace newton
