/// Couplings of a contact into the profile of FEBio's matrix.
///
/// FEBio inserts the rows of a block one by one, for every block that a column stands in. The blocks of a contact
/// overlap, a node standing in those of all nodes around it: here each column takes the union of its blocks at once.
#pragma once

#include "contact/base/indexed_vector.h"

#include <FECore/MatrixProfile.h>

#include <map>
#include <vector>

/// Rows of a column as FEBio's profile has them: intervals, ascending, none touching the next.
using RowIntervals = std::vector<SparseMatrixProfile::RowEntry>;

/// The intervals that cover the same rows as those given in any order, overlapping or not.
RowIntervals united(RowIntervals intervals);

/// Blocks of equations that are coupled.
class CoupledBlocks {
 public:
  /// For a matrix of that many columns.
  explicit CoupledBlocks(int columns) : columns_(columns) {}

  /// Takes a block of equations that all couple with each other. Entries below zero are left out; throws
  /// std::out_of_range for others beyond the matrix.
  void add(const std::vector<int>& equations);
  /// Takes one equation that couples with others, and with itself, but those not with each other.
  void add_star(int centre, const std::vector<int>& equations);
  /// Takes rows that have entries in columns.
  void add_rows(const std::vector<int>& rows, const std::vector<int>& columns);
  /// Has a row take the columns of others: multiples of them are to be added to it.
  void add_sum(int row, const std::vector<int>& others);
  /// Inserts all blocks. What the profile has couples both ways.
  void insert_into(SparseMatrixProfile& profile);

 private:
  /// Rows that have entries in columns; either may hold an equation more than once.
  struct Block {
    std::vector<int> columns;
    std::vector<int> rows;
  };
  /// Columns that follow each other and stand in the same blocks, as those of one node mostly do.
  struct Columns {
    mixture_contact::Index first;
    mixture_contact::Index end;
  };
  class BlocksOfColumns;
  /// Extends blocks by rows that take the columns of theirs, and adds those that they have in the profile.
  void add_sums(SparseMatrixProfile& profile);
  /// Those equations that are in the matrix.
  std::vector<int> in_matrix(const std::vector<int>& equations) const;

  int columns_;  ///< of the matrix
  mixture_contact::IndexedVector<Block> blocks_;
  std::map<int, std::vector<int>> others_of_;  ///< by rows that take their columns
};
