#include "tangent_assembly.h"

#include "contact/base/indexed_vector.h"
#include "host/mixed_form.h"
#include "newton/solver.h"

#include <FECore/FEGlobalMatrix.h>
#include <FECore/FELinearSystem.h>

#include <algorithm>

using namespace mixture_contact;

namespace {

/// Where the entries of a layout stand in another over the same nodes and fields that has displacements, too.
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

/// Of two patches over the same nodes.
bool have_same_unknowns(const Patch& one, const Patch& two) {
  return one.displacements == two.displacements && one.fields == two.fields &&
         one.multiplier_node == two.multiplier_node;
}

/// Equations at their places in a larger layout, and none elsewhere.
std::vector<int> scattered(const std::vector<int>& equations, const std::vector<Index>& places,
                           const LocalLayout& all) {
  std::vector<int> result(indexing::entries(all.size()), -1);
  for (std::size_t i = 0; i < equations.size(); ++i) mixture_contact::at(result, places[i]) = equations[i];
  return result;
}

/// A block of the tangent as FEBio takes it: square, with blocks of one size per node that begin with displacements.
/// What a block lacks of them has no equations.
FEElementMatrix element_matrix(const Patch& rows, const Patch& columns, const std::vector<int>& nodes,
                               const std::vector<int>& row_ids, const std::vector<int>& column_ids,
                               const MatrixXd& values) {
  Patch all = columns;
  all.displacements = true;
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

/// Equations that stand for prescribed values, and none in place of the others.
std::vector<int> prescribed_alone(std::vector<int> equations) {
  std::replace_if(
      equations.begin(), equations.end(), [](int equation) { return !newton::is_prescribed(equation); }, -1);
  return equations;
}

}  // namespace

bool takes_blocks(FEGlobalMatrix& matrix, bool is_constrained) { return MatrixRows(matrix) && !is_constrained; }

TangentAssembly::TangentAssembly(const ContactInterface& core, const DofMap& dofs, const LoadEquations& loads,
                                 FELinearSystem& system, FEGlobalMatrix& matrix, bool is_constrained)
    : core_(core),
      dofs_(dofs),
      loads_(loads),
      system_(system),
      matrix_(matrix),
      rows_(matrix),
      takes_blocks_(takes_blocks(matrix, is_constrained)),
      used_(loads.count(), false) {}

TangentAssembly::Ids TangentAssembly::ids_of(const Location& rows, const Location& columns) const {
  Ids ids;
  ids.nodes = dofs_.nodes(columns);
  ids.columns = dofs_.equations(core_, columns, ids.nodes);
  ids.rows = have_same_unknowns(rows.patch, columns.patch) ? ids.columns : dofs_.equations(core_, rows, ids.nodes);
  return ids;
}

void TangentAssembly::add(const Location& rows, const Location& columns, const MatrixXd& values) const {
  const Ids ids = ids_of(rows, columns);
  // FEBio solves K du = R with K = -dR/du.
  if (takes_blocks_ && dofs_.are_free(ids.nodes, ids.columns)) {
    rows_.subtract(ids.rows, ids.columns, values);
  } else {
    system_.Assemble(element_matrix(rows.patch, columns.patch, ids.nodes, ids.rows, ids.columns, values));
  }
}

void TangentAssembly::add_load(Side first, const LoadBlock& load) {
  const Location rows{first, load.rows};
  const Location columns{first, load.place.columns};
  const int own = loads_.of(core_, first, load.place);
  if (!takes_blocks_ || own < 0) return add(rows, columns, load.product().values);
  if (!has_mixed_form(load)) return;  // its product is zero
  add_mixed(own, ids_of(rows, columns), load);
  used_[own - loads_.first()] = true;
}

void TangentAssembly::add_mixed(int own, const Ids& ids, const LoadBlock& load) const {
  const MixedForm mixed = mixed_form(load);
  rows_.subtract(ids.rows, {own}, mixed.column);
  rows_.subtract({own}, ids.columns, mixed.row.transpose());
  rows_.subtract({own}, {own}, MatrixXd::Constant(1, 1, mixed.diagonal));
  if (!DofMap::are_prescribed(ids.columns)) return;
  // Their increments stand on the right-hand side as they do without mixed form: norms of residuals begin with it.
  system_.Assemble(element_matrix(load.rows, load.place.columns, ids.nodes, ids.rows, prescribed_alone(ids.columns),
                                  load.product().values));
}

void TangentAssembly::close_unused_equations() const {
  for (Index n = 0; n < used_.count(); ++n) {
    const int own = loads_.first() + indexing::as_int(n);
    if (!used_[n]) matrix_.GetSparseMatrixPtr()->set(own, own, 1);
  }
}
