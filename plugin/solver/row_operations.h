/// Multiples of rows of a matrix that have been added to other rows of it.
///
/// With T the operations, T A x = T b has the solution of A x = b.
#pragma once

#include "indexing/entries.h"

#include <vector>

namespace newton {

/// A row to which multiples of others have been added, none of which has been added to itself.
struct RowOperation {
  struct Term {
    int row;
    double factor;
  };
  int row = 0;
  std::vector<Term> terms;

  /// The term that it adds to its entry of a right-hand side.
  double added_to(const std::vector<double>& right) const {
    double sum = 0;
    for (const Term& term : terms) sum += term.factor * indexing::at(right, term.row);
    return sum;
  }
};

/// Operations on different rows of one matrix.
using RowOperations = std::vector<RowOperation>;

/// T b.
inline std::vector<double> applied(const RowOperations& operations, std::vector<double> right) {
  for (const RowOperation& operation : operations) indexing::at(right, operation.row) += operation.added_to(right);
  return right;
}

}  // namespace newton
