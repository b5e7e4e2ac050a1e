#include "enforcement/geometric_rows.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace mixture_contact {
namespace {

/// Nodes of both surfaces as one: the primary ones, then the secondary ones.
using Numbers = IndexedVector<Index>;

Index place_of(const Numbers& numbers, Index number) {
  return std::find(numbers.begin(), numbers.end(), number) - numbers.begin();
}

/// The same, of a number that is added where it is missing.
Index place_with(Numbers& numbers, Index number) {
  const Index place = place_of(numbers, number);
  if (place == numbers.count()) numbers.push_back(number);
  return place;
}

/// The R rows of a node, in columns for all nodes of the pairs around it.
struct Row {
  Numbers columns;
  MatrixXd values;                 ///< shape (R, 3 columns)
  VectorXd sizes;                  ///< per column: its largest entry
  double stiffness = 0;            ///< of the body around the node [N/mm]
  std::optional<Index> strongest;  ///< of the columns of the other surface
};

/// The blocks of an effect, per pair; null where it has none.
using PairBlocks = IndexedVector<const TangentBlock*>;

/// The stiffness of the body behind each facet of a surface that is asked for, over its area [N/mm].
class FacetStiffness {
 public:
  /// Keeps references.
  FacetStiffness(const SurfaceMesh& mesh, const Matrix3Xd& x)
      : mesh_(mesh), x_(x), found_(VectorXd::Constant(mesh.facets.count(), unknown)) {}

  double of(int facet) {
    if (found_[facet] == unknown)
      found_[facet] = mesh_.stiffness[facet] * areas_of_nodes(mesh_.facets[facet], x_).sum();
    return found_[facet];
  }

 private:
  static constexpr double unknown = -1;
  const SurfaceMesh& mesh_;
  const Matrix3Xd& x_;
  VectorXd found_;
};

/// The pairs around each node that have a part in an effect.
class PairsAroundNodes {
 public:
  /// Keeps references.
  PairsAroundNodes(const FacingPairs& facing, const PairBlocks& blocks, const FacingPositions& x)
      : blocks_(blocks),
        primary_nodes_(x.primary.cols()),
        around_(x.primary.cols() + x.secondary.cols()),
        stiffness_(VectorXd::Zero(around_.count())) {
    FacetStiffness primary(facing.primary(), x.primary);
    FacetStiffness secondary(facing.secondary(), x.secondary);
    for (Index pair = 0; pair < blocks.count(); ++pair) {
      if (blocks[pair] == nullptr) continue;
      const FacetPair& facets = facing.pairs()[pair];
      const PerSide<double> behind{{primary.of(facets.primary), secondary.of(facets.secondary)}};
      for_each_node(pair, [&](Index number) {
        around_[number].push_back(pair);
        stiffness_[number] = std::max(stiffness_[number], behind[side(number)]);
      });
    }
  }

  Index nodes() const { return around_.count(); }
  Side side(Index number) const { return number < primary_nodes_ ? Side::primary : Side::secondary; }
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
  Row row(Index number) const {
    Row row;
    Numbers places;  // of the nodes of the pairs, one pair after the other
    for (const Index pair : around_[number])
      for_each_node(pair, [&](Index other) { places.push_back(place_with(row.columns, other)); });
    row.values.setZero(R, 3 * row.columns.count());
    auto place = places.begin();
    for (const Index pair : around_[number]) {
      const LocalLayout columns = blocks_[pair]->columns.layout();
      const MatrixXd& values = blocks_[pair]->values;
      const Index own = std::find(place, places.end(), place_of(row.columns, number)) - place;
      for (Index n = 0; n < columns.nodes(); ++n, ++place)
        row.values.middleCols<3>(3 * *place) += values.block<R, 3>(R * own, columns.displacement(n, 0));
    }
    row.stiffness = stiffness_[number];
    row.sizes = row.values.reshaped(3 * R, row.columns.count()).cwiseAbs().colwise().maxCoeff().transpose();
    for (Index n = 0; n < row.columns.count(); ++n) {
      if (side(row.columns[n]) == side(number)) continue;
      if (!row.strongest || row.sizes[n] > row.sizes[*row.strongest]) row.strongest = n;
    }
    return row;
  }

 private:
  template <class Use>
  void for_each_node(Index pair, const Use& use) const {
    for (const int node : blocks_[pair]->columns.primary) use(node);
    for (const int node : blocks_[pair]->columns.secondary) use(primary_nodes_ + node);
  }

  const PairBlocks& blocks_;
  Index primary_nodes_;
  IndexedVector<Numbers> around_;  ///< per node
  VectorXd stiffness_;             ///< per node: the largest of the facets around it
};

/// Of a row's column on the other surface, and of the row of that node with the column back: whether either is kept.
bool are_coupled(const Row& one, Index column, const Row& two, Index back, double weak) {
  if (one.strongest == column || two.strongest == back) return true;
  if (weak == 0 || std::isinf(one.stiffness) || std::isinf(two.stiffness)) return true;
  return std::max(one.sizes[column], two.sizes[back]) > weak * std::min(one.stiffness, two.stiffness);
}

/// A row with what it keeps, given all of them.
TangentBlock kept_part(const PairsAroundNodes& pairs, const IndexedVector<Row>& rows, Index number, double weak) {
  const Row& row = rows[number];
  const auto keeps = [&](Index n) {
    const Row& other = rows[row.columns[n]];
    return pairs.side(row.columns[n]) == pairs.side(number) ||
           are_coupled(row, n, other, place_of(other.columns, number), weak);
  };
  PerSide<IndexedVector<int>> nodes;
  Numbers kept;  // columns of the row, those of primary nodes first
  for (const Side side : both_sides) {
    for (Index n = 0; n < row.columns.count(); ++n) {
      if (pairs.side(row.columns[n]) != side || !keeps(n)) continue;
      nodes[side].push_back(pairs.node(row.columns[n]));
      kept.push_back(n);
    }
  }
  MatrixXd values = MatrixXd::Zero(row.values.rows(), 3 * kept.count());
  for (Index n = 0; n < row.columns.count(); ++n) {
    Index place = place_of(kept, n);
    if (place == kept.count()) place = place_of(kept, *row.strongest);
    values.middleCols<3>(3 * place) += row.values.middleCols<3>(3 * n);
  }
  return {
      pairs.patch(number), {std::move(nodes[Side::primary]), std::move(nodes[Side::secondary]), {}}, std::move(values)};
}

template <int R>
NodeRows rows_of(const FacingPairs& facing, const PairBlocks& blocks, const FacingPositions& x, double weak) {
  const PairsAroundNodes around(facing, blocks, x);
  IndexedVector<Row> rows(around.nodes());
  in_parallel(rows.count(), [&](Index number) { rows[number] = around.row<R>(number); });
  NodeRows kept(rows.count());
  in_parallel(rows.count(), [&](Index number) {
    if (!rows[number].columns.empty()) kept[number] = kept_part(around, rows, number, weak);
  });
  kept.erase(std::remove_if(kept.begin(), kept.end(), [](const TangentBlock& row) { return row.values.size() == 0; }),
             kept.end());
  return kept;
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

NodeRows traction_rows(const FacingPairs& facing, const GeometricParts& pairs, const FacingPositions& x, double weak) {
  return rows_of<3>(facing, blocks_of(pairs, [](const GeometricTangent& pair) { return &pair.traction; }), x, weak);
}

NodeRows flux_rows(const FacingPairs& facing, const GeometricParts& pairs, const FacingPositions& x, int field) {
  return rows_of<1>(facing, blocks_of(pairs, [&](const GeometricTangent& pair) { return flux_of(pair, field); }), x, 0);
}

}  // namespace mixture_contact
