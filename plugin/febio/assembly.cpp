#include "assembly.h"

#include "contact/base/indexed_vector.h"
#include "contact/interface/residual_ahead.h"
#include "matrix_profile.h"
#include "matrix_rows.h"
#include "rigid_shell_bottoms.h"

#include <FECore/FEGlobalMatrix.h>
#include <FECore/FEGlobalVector.h>
#include <FECore/FELinearConstraintManager.h>
#include <FECore/FELinearSystem.h>
#include <FECore/FEModel.h>

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

}  // namespace

Fingerprint Assembly::couplings() const {
  Fingerprint found;
  dofs_.for_each_coupling(contact_.core(), [&](const std::vector<int>& ids) { found.add(ids); });
  return found;
}

void Assembly::add_to_profile(FEGlobalMatrix& matrix) {
  const TaskClock timed = contact_.core().measurements().clock(Task::stiffness);
  couplings_of_matrix_ = Fingerprint();
  SparseMatrixProfile& profile = *matrix.GetSparseMatrixProfile();
  CoupledBlocks blocks(profile.Columns());
  dofs_.for_each_coupling(contact_.core(), [&](const std::vector<int>& ids) {
    couplings_of_matrix_.add(ids);
    blocks.add(ids);
  });
  blocks.insert_into(profile);
}

ContactInterface::AddResidual Assembly::adder(FEGlobalVector& residual) const {
  return [this, &residual](const ContactInterface::Location& place, const VectorXd& values) {
    std::vector<int> nodes = dofs_.nodes(place);
    std::vector<int> ids = dofs_.equations(contact_.core(), place, nodes);
    std::vector<double> entries(values.data(), values.data() + values.size());
    residual.Assemble(nodes, ids, entries);
  };
}

void Assembly::residual(FEGlobalVector& residual, double dt) const {
  const ContactInterface& core = contact_.core();
  const TaskClock timed = core.measurements().clock(Task::residual);
  const PerSide<SurfaceFields> fields = contact_.fields();
  const RigidShellBottoms arms(surfaces_);
  core.residual(fields, dt, adder(residual));
}

void Assembly::residual_ahead(FEGlobalVector& residual, double dt) const {
  const PerSide<SurfaceFields> fields = contact_.fields();
  const RigidShellBottoms arms(surfaces_);
  mixture_contact::residual_ahead(contact_.core(), fields, dt, adder(residual));
}

void Assembly::tangent(FELinearSystem& system, FEGlobalMatrix& global, bool is_constrained, double dt) const {
  using Location = ContactInterface::Location;
  const ContactInterface& core = contact_.core();
  const TaskClock timed = core.measurements().clock(Task::stiffness);
  const MatrixRows matrix(global);
  const PerSide<SurfaceFields> fields = contact_.fields();
  const RigidShellBottoms arms(surfaces_);
  core.tangent(fields, dt, [&](const Location& rows, const Location& columns, const MatrixXd& values) {
    const std::vector<int> nodes = dofs_.nodes(columns);
    const std::vector<int> column_ids = dofs_.equations(core, columns, nodes);
    const std::vector<int> row_ids = have_same_unknowns(rows.patch, columns.patch) ? column_ids
                                                                                   : dofs_.equations(core, rows, nodes);
    // FEBio solves K du = R with K = -dR/du.
    if (matrix && !is_constrained && dofs_.are_free(nodes, column_ids)) {
      matrix.subtract(row_ids, column_ids, values);
    } else {
      system.Assemble(element_matrix(rows.patch, columns.patch, nodes, row_ids, column_ids, values));
    }
  });
}
