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

/// The entries of a local matrix in some rows and columns.
struct Entries {
  IndexedVector<Index> rows;
  IndexedVector<Index> columns;
};

/// The numbers first, first + stride, ... below `end`.
IndexedVector<Index> counted(Index first, Index end, Index stride) {
  IndexedVector<Index> numbers;
  for (Index number = first; number < end; number += stride) numbers.push_back(number);
  return numbers;
}

/// The entries in which a patch without coupled directions has a tangent: one block for each direction or field.
/// Multipliers couple with the nodes, and the nodes then do not couple with each other.
std::vector<Entries> by_directions(const LocalLayout& layout) {
  std::vector<Entries> parts;
  const Index stride = layout.per_node();
  for (Index first = 0; first < stride; ++first) {
    const IndexedVector<Index> nodes = counted(first, layout.nodes() * stride, stride);
    if (layout.has_multipliers()) {
      const IndexedVector<Index> multiplier{layout.nodes() * stride + first};
      parts.insert(parts.end(), {{nodes, multiplier}, {multiplier, nodes}, {multiplier, multiplier}});
    } else {
      parts.push_back({nodes, nodes});
    }
  }
  return parts;
}

std::vector<int> equations_at(const std::vector<int>& equations, const IndexedVector<Index>& entries) {
  std::vector<int> found;
  for (const Index entry : entries) found.push_back(mixture_contact::at(equations, entry));
  return found;
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

  /// Adds a part of a block of the tangent, K = -dR/du.
  void add(const MatrixXd& values, const Entries& part, FELinearSystem& system) const {
    const int size = indexing::as_int(all_.size());
    FEElementMatrix block;
    block.resize(size, size);
    block.zero();
    for (const Index i : part.rows) {
      double* const row = block[indexing::as_int(place(i))];
      for (const Index j : part.columns) row[place(j)] = -values(i, j);
    }
    block.SetNodes(nodes_);
    block.SetIndices(equations_of(part.rows), equations_of(part.columns));
    system.Assemble(block);
  }

 private:
  /// The equations of some entries; none for all others.
  std::vector<int> equations_of(const IndexedVector<Index>& entries) const {
    std::vector<int> ids(ids_.size(), -1);
    for (const Index entry : entries) mixture_contact::at(ids, place(entry)) = mixture_contact::at(ids_, place(entry));
    return ids;
  }
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
  void add(const std::vector<int>& equations, const MatrixXd& values, const Entries& part) {
    blocks_.push_back(
        {equations_at(equations, part.rows), equations_at(equations, part.columns), values(part.rows, part.columns)});
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

/// The entries that the tangents of a tie's patches have.
class TangentEntries {
 public:
  TangentEntries(const Tie& tie, FEModel& fem)
      : couples_directions_(couples_directions(tie)), is_constrained_(has_linear_constraints(fem)) {}

  /// True if the tangent of a patch may have any entry. FEBio distributes rigid bodies and linear constraints over the
  /// equations of all directions. `is_rigid`: whether the patch has nodes of a rigid body.
  bool are_all(const Patch& patch, bool is_rigid) const {
    return (patch.displacements && couples_directions_) || is_constrained_ || is_rigid;
  }
  std::vector<Entries> of(const Patch& patch, bool is_rigid) const {
    const LocalLayout layout = patch.layout();
    if (!are_all(patch, is_rigid)) return by_directions(layout);
    const IndexedVector<Index> all = counted(0, layout.size(), 1);
    return {{all, all}};
  }

 private:
  bool couples_directions_;
  bool is_constrained_;
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
  const TangentEntries entries(tie, dofs_.fem());
  SparseMatrixProfile& profile = *matrix.GetSparseMatrixProfile();
  newton::CoupledBlocks blocks(profile.Columns());
  tie.for_each_patch([&](const Patch& patch) {
    // FEBio couples all unknowns of a rigid body's nodes with each other.
    const bool is_rigid = equations.are_rigid(at_primary(patch));
    const std::vector<int> ids = equations.coupled(at_primary(is_rigid ? with_displacements(patch) : patch));
    if (entries.are_all(patch, is_rigid)) return blocks.add(ids);
    for (const Entries& part : by_directions(patch.layout()))
      blocks.add_rows(equations_at(ids, part.rows), equations_at(ids, part.columns));
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
  const TangentEntries entries(tie, dofs_.fem());
  Batch batch(matrix);
  const bool takes_blocks = batch && !has_linear_constraints(dofs_.fem());
  tie.tangent(fields, dt, softening, [&](const Patch& patch, const MatrixXd& values) {
    const std::vector<int> ids = equations.equations(at_primary(patch));
    const bool is_rigid = equations.are_rigid(at_primary(patch));
    const bool is_direct = takes_blocks && !are_prescribed(ids) && !is_rigid;
    for (const Entries& part : entries.of(patch, is_rigid)) {
      if (is_direct) {
        batch.add(ids, values, part);
      } else {
        InFullBlocks(equations, patch).add(values, part, system);
      }
    }
  });
  if (batch) batch.finish();
}
