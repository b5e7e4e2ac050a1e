#include "columns_beside.h"

#include "newton/solver.h"

#include <algorithm>

using namespace mixture_contact;

NodeFlags columns_beside(const NodeEquations& equations, const NodeEquations::Location& row,
                         const NodeEquations::Location& columns, const std::vector<int>& ids) {
  const LocalLayout layout = columns.patch.layout();
  NodeFlags beside(layout.nodes(), false);
  if (equations.are_rigid(row)) return beside;
  const bool is_primary = !row.patch.primary.empty();
  for (Index n = 0; n < layout.nodes(); ++n) {
    const bool is_across = (n < columns.patch.primary.count()) != is_primary;
    if (!is_across || equations.is_rigid(columns, n)) continue;
    const auto first = ids.begin() + layout.displacement(n, 0);
    beside[n] = std::none_of(first, first + 3, [](int id) { return newton::is_prescribed(id); });
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
