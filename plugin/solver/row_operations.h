/// Row operations on a matrix: multiples of rows that are added to other rows.
///
/// With the operations T, the system T A x = T b has the same solution as A x = b.
#pragma once

#include "indexing/entries.h"

#include <vector>

namespace newton {

/// The addition of multiples of rows to one row. No other operation changes these rows.
struct RowOperation {
  struct Term {
    int row;
    double factor;
  };
  int row = 0;
  std::vector<Term> terms;

  /// The change of the row's entry in a right-hand side.
  double added_to(const std::vector<double>& right) const {
    double sum = 0;
    for (const Term& term : terms) sum += term.factor * indexing::at(right, term.row);
    return sum;
  }
};

/// Operations on different rows of a matrix.
using RowOperations = std::vector<RowOperation>;

/// The right-hand side T b after the operations.
inline std::vector<double> applied(const RowOperations& operations, std::vector<double> right) {
  for (const RowOperation& operation : operations) indexing::at(right, operation.row) += operation.added_to(right);
  return right;
}

}  // namespace newton
