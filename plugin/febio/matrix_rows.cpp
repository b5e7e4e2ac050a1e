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

/// The place of a column in a row; its length where it has none.
int place_of(const Row& row, int column) {
  const int* const end = row.columns + row.length;
  const int* const found = std::lower_bound(row.columns, end, column);
  return found != end && *found == column ? indexing::as_int(found - row.columns) : row.length;
}

/// The entry of a row, zero where it has none. `column` is as the matrix stores it.
double entry(const Row& row, int column) {
  const int place = place_of(row, column);
  return place < row.length ? row.values[place] : 0;
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

/// Below this reciprocal condition unknowns do not follow from their own rows: half of the digits are lost.
constexpr double least_condition = 1e-8;

/// By which factors rows of unknowns are to be added to a row, so that it has no entries in their columns; empty where
/// those do not determine the unknowns.
VectorXd eliminating(const std::vector<Row>& of_unknowns, const std::vector<int>& unknowns, const Row& row) {
  const Index count = count_of(unknowns);
  MatrixXd own(count, count);  // transposed
  VectorXd entries(count);
  for (Index j = 0; j < count; ++j) {
    const int column = mixture_contact::at(unknowns, j);
    for (Index i = 0; i < count; ++i) own(j, i) = entry(mixture_contact::at(of_unknowns, i), column);
    entries[j] = -entry(row, column);
  }
  // Displacements, pressures and concentrations have units of their own.
  const auto scale_of = [](double diagonal) { return diagonal != 0 ? 1 / std::sqrt(std::abs(diagonal)) : 1; };
  const VectorXd scales = own.diagonal().unaryExpr(scale_of);
  const Eigen::PartialPivLU<MatrixXd> factors(scales.asDiagonal() * own * scales.asDiagonal());
  if (!(factors.rcond() > least_condition)) return {};
  return scales.cwiseProduct(factors.solve(scales.cwiseProduct(entries)));
}

/// By how much the diagonal of a row may grow. What it was is then known to this times the rounding error, 2e-11, and
/// so is a load that follows from it.
constexpr double most_growth = 1e5;

/// Whether its diagonal would be lost in what a row takes of others.
bool hides_diagonal(const VectorXd& factors, const std::vector<Row>& others, const Row& row, int diagonal) {
  double taken = 0;
  for (Index i = 0; i < factors.size(); ++i) taken += factors[i] * entry(mixture_contact::at(others, i), diagonal);
  return !(std::abs(taken) <= most_growth * std::abs(entry(row, diagonal)));
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

std::optional<newton::RowOperation> MatrixRows::eliminate(const std::vector<int>& unknowns, int row) const {
  const Row target = row_of(*rows_, row);
  std::vector<Row> of_unknowns;
  std::vector<int> columns;
  for (const int unknown : unknowns) {
    of_unknowns.push_back(row_of(*rows_, unknown));
    columns.push_back(unknown + rows_->Offset());
  }
  const bool has_places = !unknowns.empty() &&
                          std::all_of(of_unknowns.begin(), of_unknowns.end(),
                                      [&](const Row& other) { return has_places_for(target, other); });
  const VectorXd factors = has_places ? eliminating(of_unknowns, columns, target) : VectorXd();
  if (factors.size() == 0 || hides_diagonal(factors, of_unknowns, target, row + rows_->Offset())) return std::nullopt;
  newton::RowOperation operation{row, {}};
  for (Index i = 0; i < factors.size(); ++i) {
    add(factors[i], mixture_contact::at(of_unknowns, i), target);
    operation.terms.push_back({mixture_contact::at(unknowns, i), factors[i]});
  }
  return operation;
}

void MatrixRows::undo(const newton::RowOperation& operation) const {
  for (const newton::RowOperation::Term& term : operation.terms)
    add(-term.factor, row_of(*rows_, term.row), row_of(*rows_, operation.row));
}

double MatrixRows::backward_error(const std::vector<double>& solution, const std::vector<double>& right) const {
  double largest = 0;
  for (int i = 0; i < rows_->Rows(); ++i) {
    const Row row = row_of(*rows_, i);
    double left = -mixture_contact::at(right, i);
    double sizes = std::abs(left);
    for (int k = 0; k < row.length; ++k) {
      const double product = row.values[k] * mixture_contact::at(solution, row.columns[k] - rows_->Offset());
      left += product;
      sizes += std::abs(product);
    }
    if (sizes > 0) largest = std::max(largest, std::abs(left) / sizes);
  }
  return largest;
}
