/// Insertion of a contact's couplings into the profile of FEBio's matrix.
///
/// FEBio would insert the rows of each block one by one into each of its columns. The blocks of a contact overlap,
/// because a node belongs to the blocks of all nodes around it. Here, each column gets the union of the rows of all its
/// blocks at once.
#pragma once

#include "contact/base/lists.h"

#include <FECore/MatrixProfile.h>

#include <vector>

namespace newton {

/// The rows of a column in FEBio's profile: ascending intervals that do not touch each other.
using RowIntervals = std::vector<SparseMatrixProfile::RowEntry>;

/// Merges intervals in any order into the fewest ascending ones with the same rows.
void unite(RowIntervals& intervals);

/// Collects blocks of coupled equations for a profile.
class CoupledBlocks {
 public:
  /// Starts without blocks, for a matrix with this number of columns.
  explicit CoupledBlocks(int columns) : columns_(columns) {}

  /// Adds a block of equations that are all coupled with each other. Negative equations are ignored; throws
  /// std::out_of_range for equations beyond the matrix.
  void add(const std::vector<int>& equations);
  /// Adds the couplings of one equation with itself and with other equations, which are not coupled with each other.
  void add_star(int centre, const std::vector<int>& equations);
  /// Adds entries of these rows in these columns.
  void add_rows(const std::vector<int>& rows, const std::vector<int>& columns);
  /// Adds to a row the columns of other rows, because row operations will add multiples of them.
  void add_sum(int row, const std::vector<int>& others);
  /// Inserts all couplings into the profile. Couplings already in the profile are symmetric.
  void insert_into(SparseMatrixProfile& profile);

 private:
  using Index = mixture_contact::Index;
  /// Entries of rows in columns, by the numbers of the lists of their equations. A list may contain an equation more
  /// than once.
  struct Block {
    Index columns;
    Index rows;
  };
  /// A row that gets the columns of other rows.
  struct Sum {
    int row;
    Index others;  ///< number of the list of the other rows
  };
  /// Extends the blocks by the rows of add_sum(), and adds the columns that the other rows already have in the profile.
  void add_sums(SparseMatrixProfile& profile);
  /// Per column of the matrix, the blocks that contain it, ascending and without repetition.
  mixture_contact::Lists<Index> blocks_of_columns() const;
  /// Per block, the intervals of its rows.
  mixture_contact::Lists<SparseMatrixProfile::RowEntry> rows_of_blocks() const;
  /// Stores the equations that are in the matrix as a list. Returns the number of the list.
  Index list_of(const std::vector<int>& equations);
  /// Throws std::out_of_range if an equation is beyond the matrix.
  void check(int equation) const;

  int columns_;  ///< number of columns of the matrix
  mixture_contact::Lists<int> lists_;
  mixture_contact::IndexedVector<Block> blocks_;
  mixture_contact::IndexedVector<Sum> sums_;
};

}  // namespace newton
