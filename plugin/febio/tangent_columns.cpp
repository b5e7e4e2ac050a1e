#include "tangent_columns.h"

#include <algorithm>

using namespace mixture_contact;

namespace {

Patch without_nodes(Patch patch) {
  patch.primary.clear();
  patch.secondary.clear();
  return patch;
}

}  // namespace

TangentColumns::TangentColumns(const Patch& rows, const Patch& columns)
    : rows_(without_nodes(rows)), columns_of_node_(without_nodes(columns)) {}

void TangentColumns::add(const std::vector<int>& nodes, const MatrixXd& values) {
  const Index rows = row_size();
  const Index columns = column_size();
  for (std::size_t m = 0; m < nodes.size(); ++m) {
    Column& column = columns_[nodes[m]];
    const auto from = static_cast<Index>(m);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto to = static_cast<Index>(n);
      Eigen::Map<MatrixXd>(block(column, nodes[n]), rows, columns) += values.block(to * rows, from * columns, rows,
                                                                                   columns);
    }
  }
}

double* TangentColumns::block(Column& column, int node) const {
  const auto place = std::find(column.nodes.begin(), column.nodes.end(), node) - column.nodes.begin();
  const auto size = static_cast<std::size_t>(row_size() * column_size());
  const auto index = static_cast<std::size_t>(place);
  if (index == column.nodes.size()) {
    column.nodes.push_back(node);
    column.blocks.resize(column.blocks.size() + size, 0.0);
  }
  return column.blocks.data() + index * size;
}
