#include "enforcement/geometric_rows.h"

#include "base/parallel.h"

#include <algorithm>
#include <utility>

namespace mixture_contact {
namespace {

/// Nodes of both surfaces as one: the primary ones, then the secondary ones.
using Numbers = IndexedVector<Index>;

/// Where the nodes of both surfaces stand in a row.
class Places {
 public:
  explicit Places(Index nodes) : places_(nodes, none) {}

  /// Gives a node the next place behind those in `columns`, unless it has one.
  void add(Index number, Numbers& columns) {
    if (places_[number] != none) return;
    places_[number] = columns.count();
    columns.push_back(number);
  }
  Index operator[](Index number) const { return places_[number]; }
  /// Takes those of a row away.
  void clear(const Numbers& columns) {
    for (const Index number : columns) places_[number] = none;
  }

 private:
  static constexpr Index none = -1;
  Numbers places_;
};

/// The R rows of a node, in columns for all nodes of the pairs around it.
struct Row {
  Numbers columns;
  MatrixXd values;  ///< shape (R, 3 columns)
};

/// The blocks of an effect, per pair; null where it has none.
using PairBlocks = IndexedVector<const TangentBlock*>;

/// The pairs around each node that have a part in an effect.
class PairsAroundNodes {
 public:
  /// Keeps references.
  PairsAroundNodes(const PairBlocks& blocks, PerSide<Index> nodes)
      : blocks_(blocks), primary_nodes_(nodes[Side::primary]), around_(nodes[Side::primary] + nodes[Side::secondary]) {
    for (Index pair = 0; pair < blocks.count(); ++pair) {
      if (blocks[pair] != nullptr) for_each_node(pair, [&](Index number) { around_[number].push_back(pair); });
    }
  }

  Index nodes() const { return around_.count(); }
  Side side(Index number) const { return number < primary_nodes_ ? Side::primary : Side::secondary; }
  bool has_pairs(Index number) const { return !around_[number].empty(); }
  /// Of the one node of a patch.
  Index number(const Patch& alone) const {
    return alone.primary.empty() ? primary_nodes_ + alone.secondary.front() : alone.primary.front();
  }
  /// Its index within its surface.
  int node(Index number) const {
    return indexing::as_int(side(number) == Side::primary ? number : number - primary_nodes_);
  }
  /// With the fields of the effect.
  Patch patch(Index number) const {
    Patch alone = blocks_[around_[number].front()]->rows;
    alone.primary.clear();
    alone.secondary.clear();
    (side(number) == Side::primary ? alone.primary : alone.secondary).push_back(node(number));
    return alone;
  }

  template <int R>
  Row row(Index number, Places& places) const {
    Row row;
    for (const Index pair : around_[number]) for_each_node(pair, [&](Index other) { places.add(other, row.columns); });
    row.values.setZero(R, 3 * row.columns.count());
    for (const Index pair : around_[number]) {
      const LocalLayout columns = blocks_[pair]->columns.layout();
      const auto own_rows = blocks_[pair]->values.middleRows<R>(R * position_in_pair(pair, number));
      Index n = 0;
      for_each_node(pair, [&](Index other) {
        row.values.block<R, 3>(0, 3 * places[other]) += own_rows.template middleCols<3>(columns.displacement(n++, 0));
      });
    }
    places.clear(row.columns);
    return row;
  }

 private:
  template <class Use>
  void for_each_node(Index pair, const Use& use) const {
    for (const int node : blocks_[pair]->columns.primary) use(node);
    for (const int node : blocks_[pair]->columns.secondary) use(primary_nodes_ + node);
  }

  Index position_in_pair(Index pair, Index number) const {
    Index position = 0;
    Index found = 0;
    for_each_node(pair, [&](Index other) {
      if (other == number) found = position;
      ++position;
    });
    return found;
  }

  const PairBlocks& blocks_;
  Index primary_nodes_;
  IndexedVector<Numbers> around_;  ///< per node
};

/// What of R rows is not weak.
template <int R>
TangentBlock strong_part(const PairsAroundNodes& pairs, const Row& row, Index number, double weak) {
  const double least = weak * row.values.cwiseAbs().maxCoeff();
  const auto is_weak = [&](Index n) {
    return pairs.side(row.columns[n]) != pairs.side(number) &&
           row.values.block<R, 3>(0, 3 * n).cwiseAbs().maxCoeff() <= least;
  };
  PerSide<IndexedVector<int>> nodes;
  Numbers kept;  // columns of the row, those of primary nodes first
  for (const Side side : both_sides) {
    for (Index n = 0; n < row.columns.count(); ++n) {
      if (pairs.side(row.columns[n]) != side || is_weak(n)) continue;
      nodes[side].push_back(pairs.node(row.columns[n]));
      kept.push_back(n);
    }
  }
  MatrixXd values(R, 3 * kept.count());
  for (Index n = 0; n < kept.count(); ++n) values.block<R, 3>(0, 3 * n) = row.values.block<R, 3>(0, 3 * kept[n]);
  return {
      pairs.patch(number), {std::move(nodes[Side::primary]), std::move(nodes[Side::secondary]), {}}, std::move(values)};
}

template <int R>
NodeRows rows_of(const PairBlocks& blocks, PerSide<Index> nodes, double weak, NodeRows held) {
  const PairsAroundNodes around(blocks, nodes);
  NodeRows rows(around.nodes());
  for (TangentBlock& row : held) rows[around.number(row.rows)] = std::move(row);
  in_parallel_with(Places(around.nodes()), rows.count(), [&](Index number, Places& places) {
    const bool is_held = rows[number].values.size() > 0;
    if (is_held || !around.has_pairs(number)) return;
    rows[number] = strong_part<R>(around, around.row<R>(number, places), number, weak);
  });
  rows.erase(std::remove_if(rows.begin(), rows.end(), [](const TangentBlock& row) { return row.values.size() == 0; }),
             rows.end());
  return rows;
}

/// The flux of a field of a pair; null where it has none.
const TangentBlock* flux_of(const GeometricTangent& tangent, int field) {
  const auto has_it = [&](const TangentBlock& block) { return block.rows.fields.front() == field; };
  const auto found = std::find_if(tangent.fluxes.begin(), tangent.fluxes.end(), has_it);
  return found == tangent.fluxes.end() ? nullptr : &*found;
}

/// What `of` tells of the pairs that carry load.
template <class Of>
PairBlocks blocks_of(const GeometricParts& pairs, const Of& of) {
  PairBlocks blocks;
  blocks.reserve(pairs.size());
  for (const std::optional<GeometricTangent>& pair : pairs) blocks.push_back(pair ? of(*pair) : nullptr);
  return blocks;
}

}  // namespace

NodeRows traction_rows(const GeometricParts& pairs, PerSide<Index> nodes, double weak, NodeRows held) {
  return rows_of<3>(blocks_of(pairs, [](const GeometricTangent& pair) { return &pair.traction; }), nodes, weak,
                    std::move(held));
}

NodeRows flux_rows(const GeometricParts& pairs, PerSide<Index> nodes, int field, double weak, NodeRows held) {
  return rows_of<1>(blocks_of(pairs, [&](const GeometricTangent& pair) { return flux_of(pair, field); }), nodes, weak,
                    std::move(held));
}

}  // namespace mixture_contact
