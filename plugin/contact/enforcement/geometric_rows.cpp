#include "enforcement/geometric_rows.h"

#include "base/lists.h"
#include "base/parallel.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace mixture_contact {
namespace {

/// Numbers of nodes of both surfaces in one sequence: primary nodes, then secondary nodes.
using Numbers = IndexedVector<Index>;

/// The column of each node in a row, by node number.
class Places {
 public:
  explicit Places(Index nodes) : places_(nodes, none) {}

  /// Appends a node to `columns`, unless the row has it already.
  void add(Index number, Numbers& columns) {
    if (places_[number] != none) return;
    places_[number] = columns.count();
    columns.push_back(number);
  }
  Index operator[](Index number) const { return places_[number]; }
  /// Removes the nodes of a row.
  void clear(const Numbers& columns) {
    for (const Index number : columns) places_[number] = none;
  }

 private:
  static constexpr Index none = -1;
  Numbers places_;
};

/// The R rows of a node, with three columns per node of the pairs around it. The memory is reused for the next node.
template <int R>
struct Row {
  using Values = Eigen::Matrix<double, R, Eigen::Dynamic>;

  Numbers columns;
  Values memory;  ///< its first columns are used

  auto values() { return memory.leftCols(3 * columns.count()); }
  auto values() const { return memory.leftCols(3 * columns.count()); }
  /// Sets the entries of the present columns to zero.
  void set_zero() {
    if (memory.cols() < 3 * columns.count()) memory.resize(R, 6 * columns.count());
    values().setZero();
  }
};

/// The part of one effect of each pair; null for pairs without the effect.
template <class Tangent>
using PairParts = IndexedVector<const Tangent*>;

/// The number of rows per node in an effect.
template <class Tangent>
constexpr int rows_per_node = decltype(primary_rows(*std::declval<Tangent>().flat, Index()))::RowsAtCompileTime;

/// The pairs around each node that have a part in an effect.
template <class Tangent>
class PairsAroundNodes {
 public:
  static constexpr int rows = rows_per_node<Tangent>;

  PairsAroundNodes(PairParts<Tangent> parts, PerSide<Index> nodes)
      : parts_(std::move(parts)),
        primary_nodes_(nodes[Side::primary]),
        nodes_of_(nodes_of_pairs()),
        around_(nodes[Side::primary] + nodes[Side::secondary], [&](const auto& add) {
          for (Index pair = 0; pair < parts_.count(); ++pair) {
            for (const Index number : nodes_of_[pair]) add(number, pair);
          }
        }) {}

  Index nodes() const { return around_.count(); }
  Side side(Index number) const { return number < primary_nodes_ ? Side::primary : Side::secondary; }
  bool has_pairs(Index number) const { return !around_[number].empty(); }
  /// The number of the only node of a patch.
  Index number(const Patch& alone) const {
    return alone.primary.empty() ? primary_nodes_ + alone.secondary.front() : alone.primary.front();
  }
  /// The index of a node on its surface.
  int node(Index number) const {
    return indexing::as_int(side(number) == Side::primary ? number : number - primary_nodes_);
  }
  /// The patch of a node with the fields of the effect.
  Patch patch(Index number) const {
    Patch alone = parts_[around_[number].front()]->block.rows;
    alone.primary.clear();
    alone.secondary.clear();
    (side(number) == Side::primary ? alone.primary : alone.secondary).push_back(node(number));
    return alone;
  }

  void set_row(Index number, Places& places, Row<rows>& row) const {
    row.columns.clear();
    for (const Index pair : around_[number]) {
      for (const Index other : nodes_of_[pair]) places.add(other, row.columns);
    }
    row.set_zero();
    for (const Index pair : around_[number]) {
      const Tangent& part = *parts_[pair];
      const Span<Index> nodes = nodes_of_[pair];
      const Index position = std::distance(nodes.begin(), std::find(nodes.begin(), nodes.end(), number));
      if (part.flat) {
        add_flat(*part.flat, position, nodes, places, row);
      } else {
        const Index per_node = part.block.columns.layout().per_node();
        add(part.block.values.template middleRows<rows>(rows * position), per_node, nodes, places, row);
      }
    }
    places.clear(row.columns);
  }

 private:
  /// Adds rows of a pair to those of a node. `part`: rows with columns for the first nodes of the pair, or for all.
  /// `per_node`: number of columns per node, of which the first are displacements.
  template <class Rows>
  static void add(const Rows& part, Index per_node, const Span<Index>& nodes, const Places& places, Row<rows>& row) {
    Index column = 0;
    for (const Index other : nodes) {
      if (column < part.cols())
        row.values().template middleCols<3>(3 * places[other]) += part.template middleCols<3>(column);
      column += per_node;
    }
  }
  template <class Flat>
  static void add_flat(const Flat& flat, Index position, const Span<Index>& nodes, const Places& places,
                       Row<rows>& row) {
    constexpr Index corners = 3;
    if (position < corners) return add(primary_rows(flat, position), 3, nodes, places, row);
    add(secondary_rows(flat, position - corners), 3, nodes, places, row);
  }

  Lists<Index> nodes_of_pairs() const {
    Lists<Index> nodes;
    for (const Tangent* part : parts_) {
      if (part != nullptr) {
        for (const int node : part->block.columns.primary) nodes.add_to_next(node);
        for (const int node : part->block.columns.secondary) nodes.add_to_next(primary_nodes_ + node);
      }
      nodes.end_next();
    }
    return nodes;
  }

  PairParts<Tangent> parts_;
  Index primary_nodes_;
  Lists<Index> nodes_of_;  ///< per pair, its nodes; empty for a pair without a part
  Lists<Index> around_;    ///< per node, the pairs around it
};

/// Working memory of a thread for one row; it is reused for the next row.
template <int R>
struct RowMemory {
  Places places;
  Row<R> row;
  Numbers kept;
};

/// The entries of R rows that are not weak, columns of primary nodes first. `kept`: memory for the remaining nodes.
template <class Tangent, int R>
TangentBlock strong_part(const PairsAroundNodes<Tangent>& pairs, const Row<R>& row, Index number, double weak,
                         Numbers& kept) {
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

template <class Tangent>
NodeRows rows_of(PairParts<Tangent> parts, PerSide<Index> nodes, double weak, NodeRows held) {
  const PairsAroundNodes<Tangent> around(std::move(parts), nodes);
  NodeRows rows(around.nodes());
  for (TangentBlock& row : held) rows[around.number(row.rows)] = std::move(row);
  const RowMemory<PairsAroundNodes<Tangent>::rows> memory{Places(around.nodes()), {}, {}};
  in_parallel_with(memory, rows.count(), [&](Index number, auto& own) {
    const bool is_held = rows[number].values.size() > 0;
    if (is_held || !around.has_pairs(number)) return;
    around.set_row(number, own.places, own.row);
    rows[number] = strong_part(around, own.row, number, weak, own.kept);
  });
  rows.erase(std::remove_if(rows.begin(), rows.end(), [](const TangentBlock& row) { return row.values.size() == 0; }),
             rows.end());
  return rows;
}

/// The flux of a field of a pair; null if the pair does not exchange the field.
const FluxTangent* flux_of(const GeometricTangent& tangent, int field) {
  const auto has_it = [&](const FluxTangent& flux) { return flux.block.rows.fields.front() == field; };
  const auto found = std::find_if(tangent.fluxes.begin(), tangent.fluxes.end(), has_it);
  return found == tangent.fluxes.end() ? nullptr : &*found;
}

/// The result of `of` for each pair; null for pairs that carry no load.
template <class Tangent, class Of>
PairParts<Tangent> parts_of(const GeometricParts& pairs, const Of& of) {
  PairParts<Tangent> parts;
  parts.reserve(pairs.size());
  for (const std::optional<GeometricTangent>& pair : pairs) parts.push_back(pair ? of(*pair) : nullptr);
  return parts;
}

}  // namespace

NodeRows traction_rows(const GeometricParts& pairs, PerSide<Index> nodes, double weak, NodeRows held) {
  const auto traction = [](const GeometricTangent& pair) { return &pair.traction; };
  return rows_of(parts_of<TractionTangent>(pairs, traction), nodes, weak, std::move(held));
}

NodeRows flux_rows(const GeometricParts& pairs, PerSide<Index> nodes, int field, double weak, NodeRows held) {
  const auto flux = [&](const GeometricTangent& pair) { return flux_of(pair, field); };
  return rows_of(parts_of<FluxTangent>(pairs, flux), nodes, weak, std::move(held));
}

}  // namespace mixture_contact
