#include "mixture_contact.h"

#include "tangent_columns.h"

#include <FEBioMech/FEMechModel.h>
#include <FECore/FEGlobalMatrix.h>
#include <FECore/FEGlobalVector.h>
#include <FECore/FELinearConstraintManager.h>
#include <FECore/FELinearSystem.h>
#include <FECore/FEMesh.h>
#include <FECore/FEModel.h>

#include <algorithm>
#include <array>
#include <map>

using namespace mixture_contact;

// Assembly: the core's patches in FEBio's equations.

int FEMixtureContact::InitEquations(int first) {
  first_equation_ = first;
  decide_traction();
  multiplier_node_ = deformable_node();
  return static_cast<int>(core_->multiplier_layout().size());
}

std::vector<int> FEMixtureContact::node_ids(const ContactInterface::Location& at) {
  std::vector<int> nodes;
  for (const int node : at.patch.primary) nodes.push_back(surface(at.first).NodeIndex(node));
  for (const int node : at.patch.secondary) nodes.push_back(surface(other(at.first)).NodeIndex(node));
  if (at.patch.multiplier_node) nodes.push_back(multiplier_node_);
  return nodes;
}

int FEMixtureContact::deformable_node() {
  for (const Side side : both_sides) {
    FEMixtureSurface& s = surface(side);
    for (int i = 0; i < s.Nodes(); ++i) {
      if (s.Node(i).m_rid < 0) return s.NodeIndex(i);
    }
  }
  return -1;
}

std::vector<int> FEMixtureContact::equations(const ContactInterface::Location& at, const std::vector<int>& nodes) {
  const LocalLayout layout = at.patch.layout();
  std::vector<int> ids(static_cast<std::size_t>(layout.size()), -1);
  if (at.patch.multiplier_node) {
    const MultiplierLayout own = core_->multiplier_layout();
    const int node = *at.patch.multiplier_node;
    const auto equation = [&](Index multiplier) { return first_equation_ + static_cast<int>(multiplier); };
    if (layout.has_displacements())
      ids[static_cast<std::size_t>(layout.traction_multiplier())] = equation(own.traction(node));
    for (Index k = 0; k < layout.scalar_fields(); ++k) {
      const int field = at.patch.fields[static_cast<std::size_t>(k)];
      ids[static_cast<std::size_t>(layout.flux_multiplier(k))] = equation(own.flux(node, field));
    }
  }
  for (Index node = 0; node < layout.nodes(); ++node) {
    const std::vector<int> own = node_equations(nodes[static_cast<std::size_t>(node)], at.patch);
    std::copy(own.begin(), own.end(), ids.begin() + layout.first(node));
  }
  return ids;
}

std::vector<int> FEMixtureContact::node_equations(int node, const Patch& patch) {
  const std::vector<int>& id = GetFEModel()->GetMesh().Node(node).m_ID;
  std::vector<int> equations;
  if (patch.displacements) {
    for (const int dof : displacement_dofs_) equations.push_back(id[static_cast<std::size_t>(dof)]);
  }
  for (const int field : patch.fields) equations.push_back(id[static_cast<std::size_t>(field_dof(field))]);
  return equations;
}

void FEMixtureContact::add_to_profile(FEGlobalMatrix& matrix) {
  const TaskClock timed = core_->clock(Task::stiffness);
  // Rigid nodes bring the equations of their body's rotations in as well.
  FEModel& fem = *GetFEModel();
  const std::array<int, 3> rotation{fem.GetDOFIndex("Ru"), fem.GetDOFIndex("Rv"), fem.GetDOFIndex("Rw")};
  core_->for_each_coupling([&](const ContactInterface::Location& at) {
    const std::vector<int> nodes = node_ids(at);
    std::vector<int> ids = equations(at, nodes);
    for (const int node : nodes) {
      for (const int dof : rotation) {
        if (dof >= 0 && at.patch.displacements)
          ids.push_back(fem.GetMesh().Node(node).m_ID[static_cast<std::size_t>(dof)]);
      }
    }
    matrix.build_add(ids);
  });
}

void FEMixtureContact::LoadVector(FEGlobalVector& residual, const FETimeInfo& time) {
  const TaskClock timed = core_->clock(Task::residual);
  core_->residual(fields(), time.timeIncrement, [&](const ContactInterface::Location& at, const VectorXd& values) {
    std::vector<int> nodes = node_ids(at);
    std::vector<int> ids = equations(at, nodes);
    std::vector<double> entries(values.data(), values.data() + values.size());
    residual.Assemble(nodes, ids, entries);
  });
}

namespace {

/// Where the entries of a layout stand in another over the same nodes and fields that has displacements, too.
std::vector<Index> places(const LocalLayout& layout, const LocalLayout& all) {
  std::vector<Index> places(static_cast<std::size_t>(layout.size()));
  for (Index block = 0; block < layout.blocks(); ++block) {
    for (Index i = 0; layout.has_displacements() && i < 3; ++i) {
      places[static_cast<std::size_t>(layout.displacement(block, i))] = all.displacement(block, i);
    }
    for (Index k = 0; k < layout.scalar_fields(); ++k) {
      places[static_cast<std::size_t>(layout.scalar(block, k))] = all.scalar(block, k);
    }
  }
  return places;
}

/// Equations at their places in a larger layout, and none elsewhere.
std::vector<int> spread(const std::vector<int>& equations, const std::vector<Index>& places, const LocalLayout& all) {
  std::vector<int> result(static_cast<std::size_t>(all.size()), -1);
  for (std::size_t i = 0; i < equations.size(); ++i) result[static_cast<std::size_t>(places[i])] = equations[i];
  return result;
}

}  // namespace

void FEMixtureContact::StiffnessMatrix(FELinearSystem& system, const FETimeInfo& time) {
  TaskClock timed = core_->clock(Task::stiffness);
  if (needs_square_matrices()) {
    core_->tangent(fields(), time.timeIncrement,
                   [&](const ContactInterface::Location& rows, const ContactInterface::Location& columns,
                       const MatrixXd& values) { assemble_square(system, rows, columns, values); });
    return;
  }
  std::map<std::vector<int>, TangentColumns> effects;  // by the fields of the rows: none for the traction
  core_->tangent(
      fields(), time.timeIncrement,
      [&](const ContactInterface::Location& rows, const ContactInterface::Location& columns, const MatrixXd& values) {
        const auto at = effects.try_emplace(rows.patch.fields, rows.patch, columns.patch).first;
        at->second.add(node_ids(columns), values);
        if (at->second.full()) assemble_columns(system, at->second);
      });
  for (auto& effect : effects) {
    TangentColumns& sum = effect.second;
    timed.in_host(sum.rows(), [&] { assemble_columns(system, sum); });
  }
}

bool FEMixtureContact::needs_square_matrices() {
  // FEBio resolves rigid nodes and linear constraints from square matrices; multipliers have no nodes of their own.
  const auto* mechanics = dynamic_cast<const FEMechModel*>(GetFEModel());
  const bool rigid = mechanics != nullptr && mechanics->RigidBodies() > 0;
  return rigid || GetFEModel()->GetLinearConstraintManager().LinearConstraints() > 0 ||
         core_->multiplier_layout().size() > 0;
}

void FEMixtureContact::assemble_columns(FELinearSystem& system, TangentColumns& sum) {
  const auto row_size = static_cast<int>(sum.row_size());
  const auto column_size = static_cast<int>(sum.column_size());
  for (const auto& [node, column] : sum.by_node()) {
    std::vector<int> rows;
    for (const int other : column.nodes) {
      const std::vector<int> own = node_equations(other, sum.rows());
      rows.insert(rows.end(), own.begin(), own.end());
    }
    // FEBio takes as many columns as rows for granted when it looks for prescribed ones.
    std::vector<int> columns = node_equations(node, sum.columns());
    columns.resize(std::max(columns.size(), rows.size()), -1);
    FEElementMatrix stiffness(static_cast<int>(rows.size()), column_size);
    // FEBio solves K du = R with K = -dR/du.
    const double* entry = column.blocks.data();
    for (int first = 0; first < stiffness.rows(); first += row_size) {
      for (int j = 0; j < column_size; ++j) {
        for (int i = 0; i < row_size; ++i) stiffness[first + i][j] = -*entry++;
      }
    }
    stiffness.SetNodes(column.nodes);
    stiffness.SetIndices(rows, columns);
    system.Assemble(stiffness);
  }
  sum.clear();
}

void FEMixtureContact::assemble_square(FELinearSystem& system, const ContactInterface::Location& rows,
                                       const ContactInterface::Location& columns, const MatrixXd& values) {
  // Blocks of one size per node that begin with displacements. What a block lacks of them has no equations.
  Patch all = columns.patch;
  all.displacements = true;
  const LocalLayout layout = all.layout();
  const std::vector<int> nodes = node_ids(columns);
  const std::vector<Index> row_places = places(rows.patch.layout(), layout);
  const std::vector<Index> column_places = places(columns.patch.layout(), layout);
  const int size = static_cast<int>(layout.size());
  FEElementMatrix stiffness;
  stiffness.resize(size, size);
  stiffness.zero();
  // FEBio solves K du = R with K = -dR/du.
  for (Index i = 0; i < values.rows(); ++i) {
    double* row = stiffness[static_cast<int>(row_places[static_cast<std::size_t>(i)])];
    for (Index j = 0; j < values.cols(); ++j) row[column_places[static_cast<std::size_t>(j)]] = -values(i, j);
  }
  stiffness.SetNodes(nodes);
  stiffness.SetIndices(spread(equations(rows, nodes), row_places, layout),
                       spread(equations(columns, nodes), column_places, layout));
  system.Assemble(stiffness);
}
