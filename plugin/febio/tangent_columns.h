/// The tangent of one effect, summed on its way into FEBio's matrix.
#pragma once

#include "contact/patch.h"

#include <unordered_map>
#include <vector>

/// Sums the blocks of one effect's tangent by columns. Blocks around neighbouring nodes overlap, and FEBio looks up the
/// place of every entry that it is handed: summed before, each entry is looked up once.
class TangentColumns {
 public:
  /// All that depends on the unknowns of one node.
  struct Column {
    std::vector<int> nodes;      ///< whose equations do, in the order of their first block
    std::vector<double> blocks;  ///< one of shape (row_size(), column_size()) per node, column by column
  };

  /// `rows` and `columns` of the effect's blocks: which unknowns of a node they hold; their nodes do not matter.
  TangentColumns(const mixture_contact::Patch& rows, const mixture_contact::Patch& columns);

  /// Adds a block, `values`, over nodes of the model's mesh. Shape: (nodes x row_size(), nodes x column_size()).
  void add(const std::vector<int>& nodes, const mixture_contact::MatrixXd& values);

  /// Whether it holds so much that it is to be assembled before more is added.
  bool full() const { return columns_.size() >= most_columns; }
  void clear() { columns_.clear(); }

  const mixture_contact::Patch& rows() const { return rows_; }
  const mixture_contact::Patch& columns() const { return columns_of_node_; }
  mixture_contact::Index row_size() const { return rows_.layout().per_node(); }
  mixture_contact::Index column_size() const { return columns_of_node_.layout().per_node(); }

  /// The columns so far, by node.
  const std::unordered_map<int, Column>& by_node() const { return columns_; }

 private:
  /// Some 40 MB of displacements.
  static constexpr std::size_t most_columns = 10000;

  double* block(Column& column, int node) const;

  mixture_contact::Patch rows_;
  mixture_contact::Patch columns_of_node_;
  std::unordered_map<int, Column> columns_;
};
