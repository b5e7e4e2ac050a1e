/// Couplings of a contact in the profile of FEBio's matrix.
///
/// FEBio inserts the rows of a block one by one, for every block that a column belongs to. The blocks of a contact
/// overlap, since a node belongs to those of all nodes around it: here a column takes the union of its blocks at once.
#pragma once

#include "contact/base/lists.h"

#include <FECore/MatrixProfile.h>

#include <vector>

namespace newton {

/// Rows of a column as FEBio's profile has them: intervals, ascending, none touching the next.
using RowIntervals = std::vector<SparseMatrixProfile::RowEntry>;

/// Merges intervals in any order into the fewest ascending ones that cover the same rows.
void unite(RowIntervals& intervals);

/// Blocks of equations that are coupled.
class CoupledBlocks {
 public:
  /// Blocks of a matrix of that many columns.
  explicit CoupledBlocks(int columns) : columns_(columns) {}

  /// Takes a block of equations that all couple with each other. Entries below zero are left out; throws
  /// std::out_of_range for others beyond the matrix.
  void add(const std::vector<int>& equations);
  /// Takes one equation that couples with itself and with others, which do not couple with each other.
  void add_star(int centre, const std::vector<int>& equations);
  /// Takes rows that have entries in columns.
  void add_rows(const std::vector<int>& rows, const std::vector<int>& columns);
  /// Gives a row the columns of others, whose multiples are added to it later.
  void add_sum(int row, const std::vector<int>& others);
  /// Inserts all blocks. The couplings in the profile go both ways.
  void insert_into(SparseMatrixProfile& profile);

 private:
  using Index = mixture_contact::Index;
  /// Rows that have entries in columns, as lists of equations; either may hold one more than once.
  struct Block {
    Index columns;
    Index rows;
  };
  /// A row that takes the columns of others.
  struct Sum {
    int row;
    Index others;  ///< the list of them
  };
  /// Extends blocks by rows that take the columns of theirs, and adds those that they have in the profile.
  void add_sums(SparseMatrixProfile& profile);
  /// Per column of the matrix the blocks that it belongs to, ascending, each once.
  mixture_contact::Lists<Index> blocks_of_columns() const;
  /// Per block its rows.
  mixture_contact::Lists<SparseMatrixProfile::RowEntry> rows_of_blocks() const;
  /// Keeps a list of those equations that are in the matrix, and returns its number.
  Index list_of(const std::vector<int>& equations);
  void check(int equation) const;

  int columns_;  ///< of the matrix
  mixture_contact::Lists<int> lists_;
  mixture_contact::IndexedVector<Block> blocks_;
  mixture_contact::IndexedVector<Sum> sums_;
};

}  // namespace newton
