#include "interface/carried_state.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace mixture_contact {
namespace {

/// The nodes that the surface had before and still has.
CommonNodes common_nodes(const IndexedVector<int>& before, const IndexedVector<int>& now) {
  std::unordered_map<int, Index> known;
  for (Index node = 0; node < before.count(); ++node) known.emplace(before[node], node);
  CommonNodes common;
  for (Index node = 0; node < now.count(); ++node) {
    const auto found = known.find(now[node]);
    if (found != known.end()) common.emplace_back(node, found->second);
  }
  return common;
}

/// The columns of the nodes that a surface had before, those of its other nodes from `now`; empty if `before` is.
Matrix3Xd carried_columns(const Matrix3Xd& before, const Matrix3Xd& now, const CommonNodes& nodes) {
  if (before.cols() == 0) return {};
  Matrix3Xd columns = now;
  for (const auto& [node, source] : nodes) columns.col(node) = before.col(source);
  return columns;
}

}  // namespace

ContactInterface::State carried_over(const NumberedState& before, NumberedState fresh,
                                     const PerSide<Matrix3Xd>& position) {
  ContactInterface::State& state = fresh.state;
  PerSide<CommonNodes> common;
  for (const Side side : both_sides) common[side] = common_nodes(before.nodes[side], fresh.nodes[side]);
  const std::size_t passes = std::min(state.multipliers.size(), before.state.multipliers.size());
  for (std::size_t pass = 0; pass < passes; ++pass)
    carry_over(state.multipliers[pass], before.state.multipliers[pass], common[both_sides.at(pass)]);
  for (const Side side : both_sides)
    state.slips_from[side] = carried_columns(before.state.slips_from[side], position[side], common[side]);
  state.overlap = before.state.overlap;
  return std::move(fresh.state);
}

}  // namespace mixture_contact
