#include "interface/carried_state.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace mixture_contact {
namespace {

/// Calls use(now, before) with both indices of each node that the surface had before and still has.
template <class Use>
void for_each_common(const IndexedVector<int>& before, const IndexedVector<int>& now, const Use& use) {
  std::unordered_map<int, Index> known;
  for (Index node = 0; node < before.count(); ++node) known.emplace(before[node], node);
  for (Index node = 0; node < now.count(); ++node) {
    const auto found = known.find(now[node]);
    if (found != known.end()) use(node, found->second);
  }
}

/// Copies the column of a node, unless one of the matrices is empty.
void copy_node(Matrix3Xd& to, Index node, const Matrix3Xd& from, Index source) {
  if (to.cols() > 0 && from.cols() > 0) to.col(node) = from.col(source);
}

void copy_node(NodeFlags& to, Index node, const NodeFlags& from, Index source) {
  if (!to.empty() && !from.empty()) to[node] = from[source];
}

void copy_node(Multipliers& to, Index node, const Multipliers& from, Index source) {
  to.traction[node] = from.traction[source];
  to.flux.col(node) = from.flux.col(source);
  to.accepted_traction[node] = from.accepted_traction[source];
  copy_node(to.flux_coupled, node, from.flux_coupled, source);
  copy_node(to.friction, node, from.friction, source);
  copy_node(to.slips, node, from.slips, source);
}

void carry_over(Multipliers& to, const Multipliers& from, const IndexedVector<int>& before,
                const IndexedVector<int>& now) {
  if (from.flux.rows() != to.flux.rows()) return;
  to.traction_penalty_scale = from.traction_penalty_scale;
  to.flux_penalty_scale = from.flux_penalty_scale;
  to.friction_penalty_scale = from.friction_penalty_scale;
  for_each_common(before, now, [&](Index node, Index source) { copy_node(to, node, from, source); });
}

}  // namespace

ContactInterface::State carried_over(const NumberedState& before, NumberedState fresh,
                                     const PerSide<Matrix3Xd>& position) {
  ContactInterface::State& state = fresh.state;
  const std::size_t passes = std::min(state.multipliers.size(), before.state.multipliers.size());
  for (std::size_t pass = 0; pass < passes; ++pass) {
    const Side side = both_sides.at(pass);
    carry_over(state.multipliers[pass], before.state.multipliers[pass], before.nodes[side], fresh.nodes[side]);
  }
  for (const Side side : both_sides) {
    const Matrix3Xd& from = before.state.slips_from[side];
    if (from.cols() == 0 || state.multipliers.front().friction.cols() == 0) continue;
    Matrix3Xd& to = state.slips_from[side];
    to = position[side];
    for_each_common(before.nodes[side], fresh.nodes[side],
                    [&](Index node, Index source) { copy_node(to, node, from, source); });
  }
  return std::move(fresh.state);
}

}  // namespace mixture_contact
