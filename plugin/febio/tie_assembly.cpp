#include "tie_assembly.h"

#include "bound_contact.h"
#include "contact/base/parallel.h"
#include "rigid_shell_bottoms.h"
#include "solver/febio/matrix_profile.h"
#include "solver/febio/matrix_rows.h"
#include "tangent_assembly.h"

#include <FECore/FEGlobalMatrix.h>
#include <FECore/FEGlobalVector.h>
#include <FECore/FELinearSystem.h>

using namespace mixture_contact;

namespace {

using Location = NodeEquations::Location;

Location at_primary(const Patch& patch) { return {Side::primary, patch}; }

/// The patch with displacements, because FEBio requires node blocks of equal size that begin with displacements.
Patch with_displacements(Patch patch) {
  patch.displacements = true;
  return patch;
}

/// A local vector or matrix of a patch in blocks that begin with displacements. Added displacements have no equations.
class InFullBlocks {
 public:
  InFullBlocks(const NodeEquations& equations, const Patch& patch)
      : own_(patch.layout()),
        all_(with_displacements(patch).layout()),
        is_same_(patch.displacements),
        nodes_(equations.nodes(at_primary(patch))),
        ids_(indexing::entries(all_.size()), -1) {
    const std::vector<int> own_ids = equations.equations(at_primary(patch));
    for (Index i = 0; i < own_.size(); ++i) mixture_contact::at(ids_, place(i)) = mixture_contact::at(own_ids, i);
  }

  void add(const VectorXd& values, FEGlobalVector& residual) {
    std::vector<double> entries(ids_.size(), 0.0);
    for (Index i = 0; i < own_.size(); ++i) mixture_contact::at(entries, place(i)) = values[i];
    residual.Assemble(nodes_, ids_, entries);
  }

  /// Adds a block of the tangent, K = -dR/du.
  void add(const MatrixXd& values, FELinearSystem& system) const {
    const int size = indexing::as_int(all_.size());
    FEElementMatrix block;
    block.resize(size, size);
    block.zero();
    for (Index i = 0; i < own_.size(); ++i) {
      double* const row = block[indexing::as_int(place(i))];
      for (Index j = 0; j < own_.size(); ++j) row[place(j)] = -values(i, j);
    }
    block.SetNodes(nodes_);
    block.SetIndices(ids_);
    system.Assemble(block);
  }

 private:
  Index place(Index entry) const {
    return is_same_ ? entry : all_.scalar(entry / own_.per_node(), entry % own_.per_node());
  }

  LocalLayout own_;
  LocalLayout all_;
  bool is_same_;
  std::vector<int> nodes_;
  std::vector<int> ids_;
};

/// Blocks that are collected before they are added to a matrix that FEBio stores by rows.
class Batch {
 public:
  explicit Batch(FEGlobalMatrix& matrix) : rows_(matrix) {}

  explicit operator bool() const { return static_cast<bool>(rows_); }
  void add(const std::vector<int>& equations, const MatrixXd& values) {
    blocks_.push_back({equations, equations, values});
    if (blocks_.count() == batch_size) finish();
  }
  void finish() {
    rows_.subtract(blocks_);
    blocks_.clear();
  }

 private:
  newton::MatrixRows rows_;
  IndexedVector<newton::MatrixBlock> blocks_;
};

}  // namespace

NodeEquations TieAssembly::equations_of(const Tie& tie) const {
  const int first = dofs_.first_multiplier();
  return {dofs_, tie.effects(), [&tie, first](const Patch& patch, int node, std::vector<int>& ids) {
            const LocalLayout layout = patch.layout();
            for (Index i = 0; layout.has_displacements() && i < 3; ++i)
              mixture_contact::at(
                  ids, layout.displacement(layout.nodes(), i)) = patch.fields.empty()
                                                                     ? first + indexing::as_int(tie.unknown(node) + i)
                                                                     : -1;
            for (Index k = 0; k < layout.scalar_fields(); ++k)
              mixture_contact::at(
                  ids, layout.flux_multiplier(k)) = first + indexing::as_int(tie.unknown(node, patch.fields[k]));
          }};
}

void TieAssembly::add_to_profile(const Tie& tie, FEGlobalMatrix& matrix) const {
  const NodeEquations equations = equations_of(tie);
  SparseMatrixProfile& profile = *matrix.GetSparseMatrixProfile();
  newton::CoupledBlocks blocks(profile.Columns());
  tie.for_each_patch([&](const Patch& patch) {
    // FEBio couples all unknowns of a rigid body's nodes with each other.
    const bool is_rigid = equations.are_rigid(at_primary(patch));
    blocks.add(equations.coupled(at_primary(is_rigid ? with_displacements(patch) : patch)));
  });
  blocks.insert_into(profile);
}

void TieAssembly::residual(const Tie& tie, FEGlobalVector& residual, double dt) const {
  const NodeEquations equations = equations_of(tie);
  const PerSide<SurfaceFields> fields = fields_of(dofs_, tie.effects());
  const RigidShellBottoms arms(dofs_.surfaces());
  tie.residual(fields, dt, [&](const Patch& patch, const VectorXd& values) {
    InFullBlocks(equations, patch).add(values, residual);
  });
}

void TieAssembly::tangent(const Tie& tie, FELinearSystem& system, FEGlobalMatrix& matrix, double dt,
                          const Softening& softening) const {
  const NodeEquations equations = equations_of(tie);
  const PerSide<SurfaceFields> fields = fields_of(dofs_, tie.effects());
  const RigidShellBottoms arms(dofs_.surfaces());
  Batch batch(matrix);
  const bool takes_blocks = batch && !has_linear_constraints(dofs_.fem());
  tie.tangent(fields, dt, softening, [&](const Patch& patch, const MatrixXd& values) {
    const std::vector<int> ids = equations.equations(at_primary(patch));
    if (takes_blocks && !are_prescribed(ids) && !equations.are_rigid(at_primary(patch))) {
      batch.add(ids, values);
    } else {
      InFullBlocks(equations, patch).add(values, system);
    }
  });
  if (batch) batch.finish();
}
