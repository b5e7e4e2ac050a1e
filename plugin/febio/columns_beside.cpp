#include "columns_beside.h"

#include "solver/solver.h"

#include <algorithm>

using namespace mixture_contact;

bool is_free(const NodeEquations& equations, const NodeEquations::Location& row, const NodeEquations::Location& columns,
             const std::vector<int>& ids, Index n) {
  if (equations.are_rigid(row) || equations.is_rigid(columns, n)) return false;
  const auto first = ids.begin() + columns.patch.layout().displacement(n, 0);
  return std::none_of(first, first + 3, [](int id) { return newton::is_prescribed(id); });
}

NodeFlags columns_beside(const NodeEquations& equations, const NodeEquations::Location& row,
                         const NodeEquations::Location& columns, const std::vector<int>& ids) {
  NodeFlags beside(columns.patch.layout().nodes(), false);
  const bool is_primary = !row.patch.primary.empty();
  for (Index n = 0; n < beside.count(); ++n) {
    const bool is_across = (n < columns.patch.primary.count()) != is_primary;
    beside[n] = is_across && is_free(equations, row, columns, ids, n);
  }
  return beside;
}

Patch without(const Patch& patch, const NodeFlags& nodes) {
  Patch rest = patch;
  rest.primary.clear();
  rest.secondary.clear();
  for (Index n = 0; n < nodes.count(); ++n) {
    if (!nodes[n]) (n < patch.primary.count() ? rest.primary : rest.secondary).push_back(patch.node(n));
  }
  return rest;
}
