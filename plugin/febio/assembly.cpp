#include "equation.h"
#include "matrix_rows.h"
#include "mixture_contact.h"

#include <FECore/FEGlobalMatrix.h>
#include <FECore/FEGlobalVector.h>
#include <FECore/FELinearConstraintManager.h>
#include <FECore/FELinearSystem.h>
#include <FECore/FEMesh.h>
#include <FECore/FEModel.h>

#include <algorithm>
#include <array>

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
  FEMesh& mesh = GetFEModel()->GetMesh();
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
    const std::vector<int>& id = mesh.Node(nodes[static_cast<std::size_t>(node)]).m_ID;
    for (std::size_t i = 0; layout.has_displacements() && i < 3; ++i) {
      ids[static_cast<std::size_t>(layout.displacement(node, static_cast<Index>(i)))] = id[static_cast<std::size_t>(
          displacement_dofs_[i])];
    }
    for (Index k = 0; k < layout.scalar_fields(); ++k) {
      const int dof = field_dof(at.patch.fields[static_cast<std::size_t>(k)]);
      ids[static_cast<std::size_t>(layout.scalar(node, k))] = id[static_cast<std::size_t>(dof)];
    }
  }
  return ids;
}

void FEMixtureContact::for_each_coupling(const std::function<void(std::vector<int>&)>& use) {
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
    for (int& id : ids) id = equation_of(id);  // prescribed values have their places in the matrix, too
    use(ids);
  });
}

Fingerprint FEMixtureContact::couplings() {
  Fingerprint found;
  for_each_coupling([&](const std::vector<int>& ids) { found.add(ids); });
  return found;
}

void FEMixtureContact::add_to_profile(FEGlobalMatrix& matrix) {
  const TaskClock timed = core_->clock(Task::stiffness);
  couplings_of_matrix_ = Fingerprint();
  for_each_coupling([&](std::vector<int>& ids) {
    couplings_of_matrix_.add(ids);
    matrix.build_add(ids);
  });
}

void FEMixtureContact::keep_matrix_if_it_fits() {
  // FEBio shapes the matrix of a model with contact anew for each iteration, at the first one of a step even what the
  // bodies add. There the iteration has begun already, so that nothing but the shape is left to BuildMatrixProfile.
  const std::vector<FEMixtureContact*> contacts = active_contacts();
  FENewtonSolver* solver = newton_solver();
  if (solver == nullptr || contacts.empty() || contacts.back() != this) return;
  FEModel& fem = *GetFEModel();
  const bool alone = static_cast<int>(contacts.size()) == fem.SurfacePairConstraints() &&
                     fem.NonlinearConstraints() == 0;
  const bool fits = alone && solver->m_pK->NonZeroes() > 0 && !contacts.front()->extrapolation_.begins_ahead() &&
                    std::all_of(contacts.begin(), contacts.end(), [](FEMixtureContact* contact) {
                      return contact->begun_ && contact->couplings() == contact->couplings_of_matrix_;
                    });
  solver->m_breshape = !fits;
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

/// A block of the tangent as FEBio takes it: square, with blocks of one size per node that begin with displacements.
/// What a block lacks of them has no equations.
FEElementMatrix element_matrix(const Patch& rows, const Patch& columns, const std::vector<int>& nodes,
                               const std::vector<int>& row_ids, const std::vector<int>& column_ids,
                               const MatrixXd& values) {
  Patch all = columns;
  all.displacements = true;
  const LocalLayout layout = all.layout();
  const std::vector<Index> row_places = places(rows.layout(), layout);
  const std::vector<Index> column_places = places(columns.layout(), layout);
  const int size = static_cast<int>(layout.size());
  FEElementMatrix stiffness;
  stiffness.resize(size, size);
  stiffness.zero();
  for (Index i = 0; i < values.rows(); ++i) {
    double* row = stiffness[static_cast<int>(row_places[static_cast<std::size_t>(i)])];
    for (Index j = 0; j < values.cols(); ++j) row[column_places[static_cast<std::size_t>(j)]] = -values(i, j);
  }
  stiffness.SetNodes(nodes);
  stiffness.SetIndices(spread(row_ids, row_places, layout), spread(column_ids, column_places, layout));
  return stiffness;
}

}  // namespace

bool FEMixtureContact::has_free_equations(const std::vector<int>& nodes, const std::vector<int>& equations) {
  FEMesh& mesh = GetFEModel()->GetMesh();
  return std::none_of(equations.begin(), equations.end(), [](int equation) { return equation < -1; }) &&
         std::none_of(nodes.begin(), nodes.end(), [&](int node) { return mesh.Node(node).m_rid >= 0; });
}

void FEMixtureContact::StiffnessMatrix(FELinearSystem& system, const FETimeInfo& time) {
  const TaskClock timed = core_->clock(Task::stiffness);
  const MatrixRows matrix(*newton_solver()->GetStiffnessMatrix());
  const bool unconstrained = GetFEModel()->GetLinearConstraintManager().LinearConstraints() == 0;
  core_->tangent(
      fields(), time.timeIncrement,
      [&](const ContactInterface::Location& rows, const ContactInterface::Location& columns, const MatrixXd& values) {
        const std::vector<int> nodes = node_ids(columns);
        const std::vector<int> row_ids = equations(rows, nodes);
        const std::vector<int> column_ids = equations(columns, nodes);
        // FEBio solves K du = R with K = -dR/du.
        if (matrix && unconstrained && has_free_equations(nodes, column_ids)) {
          matrix.subtract(row_ids, column_ids, values);
        } else {
          system.Assemble(element_matrix(rows.patch, columns.patch, nodes, row_ids, column_ids, values));
        }
      });
}
