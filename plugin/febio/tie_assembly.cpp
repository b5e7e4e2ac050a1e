#include "tie_assembly.h"

#include "bound_contact.h"
#include "contact/base/parallel.h"
#include "matrix_profile.h"
#include "matrix_rows.h"
#include "rigid_shell_bottoms.h"
#include "tangent_assembly.h"

#include <FECore/FEGlobalMatrix.h>
#include <FECore/FEGlobalVector.h>
#include <FECore/FELinearSystem.h>

#include <utility>

using namespace mixture_contact;

namespace {

using Location = NodeEquations::Location;

Location at_primary(Patch patch) { return {Side::primary, std::move(patch)}; }

/// The same patch with displacements, where it has none: FEBio takes blocks of one size per node that begin with them.
Patch with_displacements(Patch patch) {
  patch.displacements = true;
  return patch;
}

/// A block of the tangent as FEBio takes it, K = -dR/du. Displacements that the patch does not have get no equations.
FEElementMatrix element_matrix(const NodeEquations& equations, const Patch& patch, const MatrixXd& values) {
  const Patch all = with_displacements(patch);
  const LocalLayout own = patch.layout();
  const LocalLayout layout = all.layout();
  const std::vector<int> own_ids = equations.equations(at_primary(patch));
  std::vector<int> ids(indexing::entries(layout.size()), -1);
  const auto place = [&](Index entry) {
    return patch.displacements ? entry : layout.scalar(entry / own.per_node(), entry % own.per_node());
  };
  FEElementMatrix block;
  block.resize(indexing::as_int(layout.size()), indexing::as_int(layout.size()));
  block.zero();
  for (Index i = 0; i < own.size(); ++i) {
    mixture_contact::at(ids, place(i)) = mixture_contact::at(own_ids, i);
    double* const row = block[indexing::as_int(place(i))];
    for (Index j = 0; j < own.size(); ++j) row[place(j)] = -values(i, j);
  }
  block.SetNodes(equations.nodes(at_primary(all)));
  block.SetIndices(ids);
  return block;
}

/// Blocks on their way into a matrix that FEBio stores by rows.
class Batch {
 public:
  explicit Batch(FEGlobalMatrix& matrix) : rows_(matrix) {}

  explicit operator bool() const { return static_cast<bool>(rows_); }
  void add(std::vector<int> equations, const MatrixXd& values) {
    blocks_.push_back({equations, equations, values});
    if (blocks_.count() == batch_size) finish();
  }
  void finish() {
    rows_.subtract(blocks_);
    blocks_.clear();
  }

 private:
  MatrixRows rows_;
  IndexedVector<MatrixBlock> blocks_;
};

}  // namespace

NodeEquations TieAssembly::equations_of(const Tie& tie) const {
  const int first = dofs_.first_multiplier();
  return {dofs_, surfaces_, tie.effects(), [&tie, first](const Patch& patch, std::vector<int>& ids) {
            const LocalLayout layout = patch.layout();
            const int node = *patch.multiplier_node;
            for (Index i = 0; layout.has_displacements() && i < 3; ++i)
              mixture_contact::at(ids, layout.displacement(layout.nodes(), i)) =
                  patch.fields.empty() ? first + indexing::as_int(tie.first_unknown(node) + i) : -1;
            for (Index k = 0; k < layout.scalar_fields(); ++k)
              mixture_contact::at(ids, layout.flux_multiplier(k)) = first +
                                                                    indexing::as_int(tie.unknown(node, patch.fields[k]));
          }};
}

void TieAssembly::add_to_profile(const Tie& tie, FEGlobalMatrix& matrix) const {
  const NodeEquations equations = equations_of(tie);
  SparseMatrixProfile& profile = *matrix.GetSparseMatrixProfile();
  CoupledBlocks blocks(profile.Columns());
  tie.for_each_patch([&](const Patch& patch) {
    const bool is_rigid = equations.are_rigid(at_primary(patch));  // FEBio couples a body by all that its nodes have
    blocks.add(equations.coupled(at_primary(is_rigid ? with_displacements(patch) : patch)));
  });
  blocks.insert_into(profile);
}

void TieAssembly::residual(const Tie& tie, FEGlobalVector& residual, double dt) const {
  const NodeEquations equations = equations_of(tie);
  const RigidShellBottoms arms(surfaces_);
  tie.residual(fields_of(surfaces_, dofs_, tie.effects()), dt, [&](const Patch& patch, const VectorXd& values) {
    std::vector<int> nodes = equations.nodes(at_primary(patch));
    std::vector<int> ids = equations.equations(at_primary(patch));
    std::vector<double> entries(values.data(), values.data() + values.size());
    residual.Assemble(nodes, ids, entries);
  });
}

void TieAssembly::tangent(const Tie& tie, FELinearSystem& system, FEGlobalMatrix& matrix, double dt) const {
  const NodeEquations equations = equations_of(tie);
  const PerSide<SurfaceFields> fields = fields_of(surfaces_, dofs_, tie.effects());
  const RigidShellBottoms arms(surfaces_);
  Batch batch(matrix);
  const bool takes_blocks = batch && !has_linear_constraints(*surfaces_[Side::primary].GetFEModel());
  tie.tangent(fields, dt, [&](const Patch& patch, const MatrixXd& values) {
    std::vector<int> ids = equations.equations(at_primary(patch));
    if (takes_blocks && !are_prescribed(ids) && !equations.are_rigid(at_primary(patch))) {
      batch.add(std::move(ids), values);
    } else {
      system.Assemble(element_matrix(equations, patch, values));
    }
  });
  if (batch) batch.finish();
}
