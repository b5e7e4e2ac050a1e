#include "enforcement/geometric_rows.h"

#include "base/lists.h"
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

/// The R rows of a node, in columns for all nodes of the pairs around it. Its memory serves the next node.
template <int R>
struct Row {
  using Values = Eigen::Matrix<double, R, Eigen::Dynamic>;

  Numbers columns;
  Values memory;  ///< of which the first columns are used

  auto values() { return memory.leftCols(3 * columns.count()); }
  auto values() const { return memory.leftCols(3 * columns.count()); }
  /// For the columns that there are.
  void set_zero() {
    if (memory.cols() < 3 * columns.count()) memory.resize(R, 6 * columns.count());
    values().setZero();
  }
};

/// The blocks of an effect, per pair; null where it has none.
using PairBlocks = IndexedVector<const TangentBlock*>;

/// The pairs around each node that have a part in an effect.
class PairsAroundNodes {
 public:
  /// Keeps references.
  PairsAroundNodes(const PairBlocks& blocks, PerSide<Index> nodes)
      : blocks_(blocks),
        primary_nodes_(nodes[Side::primary]),
        around_(nodes[Side::primary] + nodes[Side::secondary], [&](const auto& add) {
          for (Index pair = 0; pair < blocks.count(); ++pair) {
            if (blocks[pair] != nullptr) for_each_node(pair, [&](Index number) { add(number, pair); });
          }
        }) {}

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
  void set_row(Index number, Places& places, Row<R>& row) const {
    row.columns.clear();
    for (const Index pair : around_[number]) for_each_node(pair, [&](Index other) { places.add(other, row.columns); });
    row.set_zero();
    for (const Index pair : around_[number]) {
      const LocalLayout columns = blocks_[pair]->columns.layout();
      const auto own_rows = blocks_[pair]->values.middleRows<R>(R * position_in_pair(pair, number));
      Index n = 0;
      for_each_node(pair, [&](Index other) {
        row.values().template middleCols<3>(3 * places[other]) += own_rows.template middleCols<3>(
            columns.displacement(n++, 0));
      });
    }
    places.clear(row.columns);
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
  Lists<Index> around_;  ///< per node
};

/// What a thread remembers of a row, whose memory serves the next one.
template <int R>
struct RowMemory {
  Places places;
  Row<R> row;
  Numbers kept;
};

/// What of R rows is not weak, columns of primary nodes first. `kept`: memory for their places.
template <int R>
TangentBlock strong_part(const PairsAroundNodes& pairs, const Row<R>& row, Index number, double weak, Numbers& kept) {
  const auto values = row.values();
  const double least = weak * values.cwiseAbs().maxCoeff();
  const auto is_weak = [&](Index n) {
    return pairs.side(row.columns[n]) != pairs.side(number) &&
           values.template middleCols<3>(3 * n).cwiseAbs().maxCoeff() <= least;
  };
  kept.clear();
  const auto keep_of = [&](Side side) {
    for (Index n = 0; n < row.columns.count(); ++n) {
      if (pairs.side(row.columns[n]) == side && !is_weak(n)) kept.push_back(n);
    }
    return kept.count();
  };
  const Index primary = keep_of(Side::primary);
  keep_of(Side::secondary);
  const auto secondary = std::next(kept.begin(), primary);
  const auto nodes_of = [&](auto begin, auto end) {
    IndexedVector<int> nodes(end - begin);
    std::transform(begin, end, nodes.begin(), [&](Index n) { return pairs.node(row.columns[n]); });
    return nodes;
  };
  TangentBlock strong{
      pairs.patch(number), {nodes_of(kept.begin(), secondary), nodes_of(secondary, kept.end()), {}}, MatrixXd()};
  strong.values.resize(R, 3 * kept.count());
  for (Index n = 0; n < kept.count(); ++n)
    strong.values.template middleCols<3>(3 * n) = values.template middleCols<3>(3 * kept[n]);
  return strong;
}

template <int R>
NodeRows rows_of(const PairBlocks& blocks, PerSide<Index> nodes, double weak, NodeRows held) {
  const PairsAroundNodes around(blocks, nodes);
  NodeRows rows(around.nodes());
  for (TangentBlock& row : held) rows[around.number(row.rows)] = std::move(row);
  const RowMemory<R> memory{Places(around.nodes()), {}, {}};
  in_parallel_with(memory, rows.count(), [&](Index number, RowMemory<R>& own) {
    const bool is_held = rows[number].values.size() > 0;
    if (is_held || !around.has_pairs(number)) return;
    around.set_row(number, own.places, own.row);
    rows[number] = strong_part(around, own.row, number, weak, own.kept);
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
