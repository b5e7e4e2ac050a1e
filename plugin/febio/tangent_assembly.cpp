#include "tangent_assembly.h"

#include "columns_beside.h"
#include "contact/base/parallel.h"
#include "host/mixed_form.h"
#include "solver/solver.h"

#include <FECore/FEGlobalMatrix.h>
#include <FECore/FELinearSystem.h>

#include <algorithm>
#include <utility>

using namespace mixture_contact;

namespace {

/// Positions of the entries of a layout in another layout of the same nodes and fields that includes displacements.
std::vector<Index> dof_map(const LocalLayout& layout, const LocalLayout& all) {
  std::vector<Index> places(indexing::entries(layout.size()));
  for (Index block = 0; block < layout.blocks(); ++block) {
    for (Index i = 0; layout.has_displacements() && i < 3; ++i) {
      mixture_contact::at(places, layout.displacement(block, i)) = all.displacement(block, i);
    }
    for (Index k = 0; k < layout.scalar_fields(); ++k) {
      mixture_contact::at(places, layout.scalar(block, k)) = all.scalar(block, k);
    }
  }
  return places;
}

/// True if two patches of the same nodes have the same kinds of unknowns.
bool have_same_unknowns(const Patch& one, const Patch& two) {
  return one.displacements == two.displacements && one.fields == two.fields &&
         one.multiplier_node == two.multiplier_node;
}

/// Equations at their positions in a larger layout, and -1 at all other positions.
std::vector<int> scattered(const std::vector<int>& equations, const std::vector<Index>& places,
                           const LocalLayout& all) {
  std::vector<int> result(indexing::entries(all.size()), -1);
  for (std::size_t i = 0; i < equations.size(); ++i) mixture_contact::at(result, places[i]) = equations[i];
  return result;
}

/// A block of the tangent in the form that FEBio requires: square, with node blocks of equal size that begin with
/// displacements. Added unknowns have no equations.
FEElementMatrix element_matrix(const Patch& rows, const Patch& columns, const std::vector<int>& nodes,
                               const std::vector<int>& row_ids, const std::vector<int>& column_ids,
                               const MatrixXd& values) {
  Patch all = columns;
  all.displacements = true;
  if (all.fields.empty()) all.fields = rows.fields;
  const LocalLayout layout = all.layout();
  const std::vector<Index> row_places = dof_map(rows.layout(), layout);
  const std::vector<Index> column_places = dof_map(columns.layout(), layout);
  const int size = indexing::as_int(layout.size());
  FEElementMatrix stiffness;
  stiffness.resize(size, size);
  stiffness.zero();
  for (Index i = 0; i < values.rows(); ++i) {
    double* row = stiffness[indexing::as_int(mixture_contact::at(row_places, i))];
    for (Index j = 0; j < values.cols(); ++j) row[mixture_contact::at(column_places, j)] = -values(i, j);
  }
  stiffness.SetNodes(nodes);
  stiffness.SetIndices(scattered(row_ids, row_places, layout), scattered(column_ids, column_places, layout));
  return stiffness;
}

/// The equations of prescribed values, and -1 in place of all others.
std::vector<int> prescribed_alone(std::vector<int> equations) {
  std::replace_if(
      equations.begin(), equations.end(), [](int equation) { return !newton::is_prescribed(equation); }, -1);
  return equations;
}

/// The nodes of two patches, on each surface those of the first patch first.
Patch together(Patch one, const Patch& two) {
  one.primary.insert(one.primary.end(), two.primary.begin(), two.primary.end());
  one.secondary.insert(one.secondary.end(), two.secondary.begin(), two.secondary.end());
  return one;
}

/// The rows of a node and the columns of another one, in a block of both nodes.
struct OfTwoNodes {
  Patch rows;
  Patch columns;
  Index row;     ///< position of the node of the rows
  Index column;  ///< position of the node of the columns
  MatrixXd values;
};

OfTwoNodes of_two_nodes(const TangentBlock& block, Index n) {
  const Patch column = block.columns.of_node(n);
  const bool is_one = block.rows.primary == column.primary && block.rows.secondary == column.secondary;
  OfTwoNodes both{block.rows, is_one ? column : together(column, block.rows), 0, 0, {}};
  both.rows.primary = both.columns.primary;
  both.rows.secondary = both.columns.secondary;
  const Index last = both.columns.layout().nodes() - 1;
  both.row = block.rows.primary.empty() ? last : both.columns.primary.count() - 1;
  both.column = is_one ? both.row : last - both.row;
  const Index height = block.values.rows();
  both.values.setZero(both.rows.layout().size(), both.columns.layout().size());
  both.values.block(height * both.row, both.columns.layout().displacement(both.column, 0), height,
                    3) = block.values.middleCols<3>(block.columns.layout().displacement(n, 0));
  return both;
}

/// The equations of one node, and -1 in place of those of other nodes.
std::vector<int> alone(std::vector<int> equations, const LocalLayout& layout, Index node) {
  for (Index i = 0; i < count_of(equations); ++i) {
    if (i / layout.per_node() != node) mixture_contact::at(equations, i) = -1;
  }
  return equations;
}

/// Removes the columns of these nodes from a block. Returns them with the sign of FEBio's matrix, K = -dR/du.
newton::MatrixBlock taken_out(newton::MatrixBlock& block, const NodeFlags& nodes, const LocalLayout& columns) {
  newton::MatrixBlock taken;
  const Index count = std::count(nodes.begin(), nodes.end(), true);
  if (count == 0) return taken;
  taken.rows = block.rows;
  taken.values.resize(block.values.rows(), 3 * count);
  for (Index n = 0; n < nodes.count(); ++n) {
    if (!nodes[n]) continue;
    const Index first = columns.displacement(n, 0);
    taken.values.middleCols<3>(count_of(taken.columns)) = -block.values.middleCols<3>(first);
    const auto ids = block.columns.begin() + first;
    taken.columns.insert(taken.columns.end(), ids, ids + 3);
    std::fill(ids, ids + 3, -1);
  }
  return taken;
}

}  // namespace

bool are_prescribed(const std::vector<int>& equations) {
  return std::any_of(equations.begin(), equations.end(), [](int equation) { return newton::is_prescribed(equation); });
}

bool takes_blocks(FEGlobalMatrix& matrix, bool is_constrained) { return newton::MatrixRows(matrix) && !is_constrained; }

TangentAssembly::TangentAssembly(const ContactInterface& core, const NodeEquations& equations,
                                 const LoadEquations& loads, FELinearSystem& system, FEGlobalMatrix& matrix,
                                 Takes takes)
    : core_(core),
      equations_(equations),
      loads_(loads),
      system_(system),
      matrix_(matrix),
      rows_(matrix),
      takes_{takes.blocks, takes.blocks && takes.loads} {}

TangentAssembly::Ids TangentAssembly::ids_of(const Location& rows, const Location& columns) const {
  Ids ids;
  ids.columns = equations_.equations(columns);
  ids.rows = have_same_unknowns(rows.patch, columns.patch) ? ids.columns : equations_.equations(rows);
  return ids;
}

bool TangentAssembly::is_free(const Ids& ids, const Location& columns) const {
  return takes_.blocks && !are_prescribed(ids.columns) && !equations_.are_rigid(columns);
}

TangentAssembly::Kept& TangentAssembly::kept_of(const Patch& rows) {
  return kept_[rows.fields.empty() ? std::optional<int>() : rows.fields.front()];
}

void TangentAssembly::keep(const Patch& rows, newton::MatrixBlock block) {
  Kept& kept = kept_of(rows);
  if (kept.blocks.empty()) kept.rows = rows;
  kept.blocks.push_back(std::move(block));
  if (kept.blocks.count() == batch_size) take_over(kept);
}

void TangentAssembly::take_over(Kept& kept) const {
  rows_.subtract(kept.blocks);
  kept.blocks.clear();
}

void TangentAssembly::assemble(const Patch& rows, const FEElementMatrix& block) {
  take_over(kept_of(rows));
  system_.Assemble(block);
}

void TangentAssembly::add(const Location& rows, const Location& columns, const MatrixXd& values) {
  Ids ids = ids_of(rows, columns);
  // FEBio solves K du = R with K = -dR/du.
  if (is_free(ids, columns)) {
    keep(rows.patch, {std::move(ids.rows), std::move(ids.columns), values});
  } else {
    assemble(rows.patch,
             element_matrix(rows.patch, columns.patch, equations_.nodes(columns), ids.rows, ids.columns, values));
  }
}

IndexedVector<Index> TangentAssembly::take_out_bound(const Location& row, const Location& columns,
                                                     std::vector<int>& equations) const {
  IndexedVector<Index> bound;
  const LocalLayout layout = columns.patch.layout();
  for (Index n = 0; n < layout.nodes(); ++n) {
    const auto first = equations.begin() + layout.displacement(n, 0);
    if (::is_free(equations_, row, columns, equations, n)) continue;
    std::fill(first, first + 3, -1);
    bound.push_back(n);
  }
  return bound;
}

void TangentAssembly::add_rows(Side first, const Rows& rows, double factor, newton::MatrixPart* beside) {
  take_over(kept_of(rows.front().rows));  // adds the earlier blocks first
  for (Index begin = 0; begin < rows.count(); begin += batch_size) add_batch(first, rows, begin, factor, beside);
}

void TangentAssembly::add_batch(Side first, const Rows& rows, Index begin, double factor, newton::MatrixPart* beside) {
  const Index count = std::min(batch_size, rows.count() - begin);
  IndexedVector<newton::MatrixBlock> made(count);
  IndexedVector<IndexedVector<Index>> bound(count);
  IndexedVector<newton::MatrixBlock> apart(count);
  in_parallel(count, [&](Index n) {
    const TangentBlock& block = rows[begin + n];
    const Location row{first, block.rows};
    const Location columns{first, block.columns};
    made[n] = {equations_.equations(row), equations_.equations(columns), factor * block.values};
    if (beside != nullptr)
      apart[n] = taken_out(made[n], columns_beside(equations_, row, columns, made[n].columns), columns.patch.layout());
    bound[n] = take_out_bound(row, columns, made[n].columns);
  });
  for (newton::MatrixBlock& block : apart) {
    if (block.values.size() > 0) beside->add(std::move(block));
  }
  rows_.subtract(made);
  for (Index n = 0; n < count; ++n) {
    for (const Index column : bound[n]) add_bound(first, rows[begin + n], column, factor);
  }
}

void TangentAssembly::add_bound(Side first, const TangentBlock& row, Index n, double factor) {
  const OfTwoNodes both = of_two_nodes(row, n);
  const Location rows{first, both.rows};
  const Location columns{first, both.columns};
  // FEBio would search without end for an entry that is not in the profile, and the rows of the other node may have no
  // entries in these columns.
  const std::vector<int> row_ids = alone(equations_.equations(rows), both.rows.layout(), both.row);
  const std::vector<int> column_ids = alone(equations_.equations(columns), both.columns.layout(), both.column);
  system_.Assemble(
      element_matrix(both.rows, both.columns, equations_.nodes(columns), row_ids, column_ids, factor * both.values));
}

void TangentAssembly::add_load(Side first, const LoadBlock& load) {
  const Location rows{first, load.rows};
  const Location columns{first, load.place.columns};
  UnknownLoad own = loads_.unknown(equations_, core_, first, load.place);
  const bool is_unknown = takes_.loads && own.equation >= 0;
  if (!is_unknown) return add(rows, columns, load.product().values);
  if (!has_mixed_form(load)) return;  // the load does not depend on the unknowns
  add_mixed(own.equation, load, rows, columns);
  unknown_loads_.push_back(std::move(own));
}

PerSide<bool> TangentAssembly::has_loads() const {
  return {{takes_.loads && loads_.has(Side::primary), takes_.loads && loads_.has(Side::secondary)}};
}

void TangentAssembly::add_mixed(int own, const LoadBlock& load, const Location& rows, const Location& columns) {
  const Ids ids = ids_of(rows, columns);
  const MixedForm mixed = mixed_form(load);
  keep(load.rows, {ids.rows, {own}, mixed.column});
  keep(load.rows, {{own}, ids.columns, mixed.row.transpose()});
  keep(load.rows, {{own}, {own}, MatrixXd::Constant(1, 1, mixed.diagonal)});
  if (!are_prescribed(ids.columns)) {
    if (!load.place.field) unknown_tractions_.push_back({rows.first, load.place.node, own, mixed.load});
    return;
  }
  // The loads by prescribed increments are on the right-hand side as without the mixed form, because norms of residuals
  // start with it. In the matrix, they have no entries that would have to be added after the collected blocks.
  system_.Assemble(element_matrix(load.rows, load.place.columns, equations_.nodes(columns), ids.rows,
                                  prescribed_alone(ids.columns), load.product().values));
}

void TangentAssembly::finish(TaskClock& timed) {
  for (auto& effect : kept_) timed.in_host(effect.second.rows, [&] { take_over(effect.second); });
  IndexedVector<bool> is_used(loads_.count(), false);
  for (const UnknownLoad& load : unknown_loads_) is_used[load.equation - loads_.first()] = true;
  for (Index n = 0; n < is_used.count(); ++n) {
    const int own = loads_.first() + indexing::as_int(n);
    if (!is_used[n]) matrix_.GetSparseMatrixPtr()->set(own, own, 1);
  }
}
