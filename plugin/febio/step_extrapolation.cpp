#include "step_extrapolation.h"

#include "archive.h"
#include "solver_totals.h"

#include <FEBioMech/FEMechModel.h>
#include <FEBioMech/FESolidSolver2.h>
#include <FECore/DumpStream.h>
#include <FECore/FEGlobalMatrix.h>
#include <FECore/FELoadController.h>
#include <FECore/FEMesh.h>
#include <FECore/FEModel.h>
#include <FECore/FENewtonSolver.h>
#include <FECore/SparseMatrix.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

using Eigen::Index;
using Eigen::MatrixXd;
using mixture_contact::PastSteps;

namespace {

/// Load curves turn where what they told of a change differs from it by more than this part.
constexpr double largest_turn = 1.0 / 3.0;
/// Of the differences of load values of 1, extrapolated.
constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
/// Newton's method takes no more for a linear step that starts at the end of the last one: one to solve it, and one in
/// which FEBio compares the increment with it.
constexpr int least_iterations = 2;
/// Where a step takes no more than those, to begin ahead is tried when less than half of this part of the last change
/// would have been missed, and after a try in vain when less than half of what was missed there is.
constexpr double most_missed = 0.1;
constexpr double better = 0.5;
/// Of the expected change, the part that is left to the first increment. FEBio measures residuals and energies against
/// those of the first increment, so it must not be rounding, where the expected state is the solution.
constexpr double part_left = 1e-4;

std::vector<double> scaled(std::vector<double> vector, double factor) {
  for (double& entry : vector) entry *= factor;
  return vector;
}

/// Degrees of freedom of each variable (displacement, pressure, one concentration).
std::vector<std::vector<int>> variables_of(FEModel& fem) {
  DOFS& dofs = fem.GetDOFS();
  std::vector<std::vector<int>> variables;
  for (int n = 0; n < dofs.Variables(); ++n) {
    std::vector<int> of_one;
    dofs.GetDOFList(n, of_one);
    if (dofs.GetVariableType(n) == VAR_ARRAY) {
      for (const int dof : of_one) variables.emplace_back(1, dof);
    } else {
      variables.push_back(std::move(of_one));
    }
  }
  return variables;
}

/// Which of the variables the displacements are.
std::size_t displacements_of(FEModel& fem) {
  const std::vector<std::vector<int>> variables = variables_of(fem);
  const int dof = fem.GetDOFIndex("x");
  const auto is_theirs = [&](const std::vector<int>& dofs) {
    return std::find(dofs.begin(), dofs.end(), dof) != dofs.end();
  };
  return static_cast<std::size_t>(std::find_if(variables.begin(), variables.end(), is_theirs) - variables.begin());
}

/// A free nodal value: its equation, degree of freedom, and where it stands among the values of its variable.
struct FreeValue {
  std::size_t equation;
  int dof;
  std::size_t variable;
  Index row;
  Index node;
};

/// Calls `use` with every free nodal value.
template <class Use>
void for_each_free_value(FEModel& fem, const Use& use) {
  FEMesh& mesh = fem.GetMesh();
  const std::vector<std::vector<int>> variables = variables_of(fem);
  for (std::size_t v = 0; v < variables.size(); ++v) {
    for (std::size_t row = 0; row < variables[v].size(); ++row) {
      const int dof = variables[v][row];
      for (int i = 0; i < mesh.Nodes(); ++i) {
        const int equation = mesh.Node(i).m_ID[static_cast<std::size_t>(dof)];
        if (equation >= 0) use({static_cast<std::size_t>(equation), dof, v, static_cast<Index>(row), Index{i}});
      }
    }
  }
}

/// Changes of the free values of each variable; zero elsewhere.
std::vector<MatrixXd> changes_of_step(FEModel& fem) {
  FEMesh& mesh = fem.GetMesh();
  std::vector<MatrixXd> changes;
  for (const std::vector<int>& dofs : variables_of(fem))
    changes.emplace_back(MatrixXd::Zero(static_cast<Index>(dofs.size()), mesh.Nodes()));
  for_each_free_value(fem, [&](const FreeValue& value) {
    const FENode& node = mesh.Node(static_cast<int>(value.node));
    changes[value.variable](value.row, value.node) = node.get(value.dof) - node.get_prev(value.dof);
  });
  return changes;
}

std::vector<double> load_values(FEModel& fem) {
  std::vector<double> values;
  for (int n = 0; n < fem.LoadControllers(); ++n) values.push_back(fem.GetLoadController(n)->Value());
  return values;
}

/// Writes or reads some past steps.
void archive_steps(DumpStream& ar, std::vector<PastSteps>& quantities) {
  int count = static_cast<int>(quantities.size());
  ar & count;
  quantities.resize(static_cast<std::size_t>(count));
  for (PastSteps& steps : quantities) steps.for_each_part([&](auto& part) { archive(ar, part); });
}

}  // namespace

bool StepExtrapolation::is_available(FEModel& fem) {
  const auto* mechanics = dynamic_cast<const FEMechModel*>(&fem);
  return mechanics == nullptr || mechanics->RigidBodies() == 0;
}

bool StepExtrapolation::suits(const FENewtonSolver* solver) {
  const auto* solids = dynamic_cast<const FESolidSolver2*>(solver);
  return solver != nullptr && (solids == nullptr || solids->m_arcLength == 0);
}

void StepExtrapolation::step_solved(int iterations) {
  if (!std::exchange(ahead_, false)) {
    iterations_plain_ = iterations;
  } else {
    missed_in_vain_ = iterations < iterations_plain_ ? most_missed : missed_;
  }
  restored_ = false;
  const std::vector<double> before = std::exchange(load_values_, load_values(fem_));
  if (std::exchange(analysis_step_, fem_.GetCurrentStepIndex()) != fem_.GetCurrentStepIndex()) {
    variables_.clear();
    loads_.clear();
    missed_in_vain_ = most_missed;
  }
  if (before.size() != load_values_.size()) return;  // the first step: what the loads were at its start is not known
  const double dt = fem_.GetTime().timeIncrement;
  const std::vector<MatrixXd> changes = changes_of_step(fem_);
  variables_.resize(changes.size());
  loads_.resize(before.size());
  for (std::size_t v = 0; v < changes.size(); ++v) variables_[v].add({changes[v], dt});
  for (std::size_t n = 0; n < before.size(); ++n)
    loads_[n].add({MatrixXd::Constant(1, 1, load_values_[n] - before[n]), dt});
  missed_ = 0;
  for (const PastSteps& variable : variables_) missed_ = std::max(missed_, variable.missed());
}

void StepExtrapolation::serialize(DumpStream& ar) {
  if (ar.IsShallow()) {
    if (ar.IsSaving()) return;
    part_of_guess_.clear();
    restored_ = true;
    ahead_ = false;
    return;
  }
  ar & analysis_step_ & iterations_plain_ & missed_ & missed_in_vain_;
  archive(ar, load_values_);
  archive_steps(ar, variables_);
  archive_steps(ar, loads_);
}

bool StepExtrapolation::loads_turn() const {
  const std::vector<double> loads = load_values(fem_);
  for (std::size_t n = 0; n < loads.size(); ++n) {
    const double actual = loads[n] - load_values_[n];
    const MatrixXd told = loads_[n].foretold(fem_.GetTime().timeIncrement);
    const double difference = (told.size() == 0 ? 0 : told.value()) - actual;
    if (std::abs(difference) > largest_turn * std::abs(actual) + rounding * std::abs(loads[n])) return true;
  }
  return false;
}

bool StepExtrapolation::is_worth_trying() const {
  if (iterations_plain_ > least_iterations) return true;
  return iterations_plain_ == least_iterations && missed_ <= better * missed_in_vain_;
}

/// A variable that is not foretold stays where it is. If displacements do, those that are prescribed would squeeze the
/// elements beside them; and where all that changes stays, there is nothing to gain.
bool StepExtrapolation::follows_the_change() const {
  const double dt = fem_.GetTime().timeIncrement;
  return variables_[displacements_of(fem_)].leads(dt) &&
         std::any_of(variables_.begin(), variables_.end(),
                     [&](const PastSteps& variable) { return variable.changed() && variable.leads(dt); });
}

bool StepExtrapolation::begins_ahead() const {
  return !restored_ && !variables_.empty() && analysis_step_ == fem_.GetCurrentStepIndex() && is_worth_trying() &&
         follows_the_change() && !loads_turn();
}

bool StepExtrapolation::move_to_expected_state(FENewtonSolver& solver, const std::function<void()>& decide) {
  ahead_ = begins_ahead();
  if (!ahead_) return false;
  std::vector<MatrixXd> changes;
  for (const PastSteps& variable : variables_) changes.push_back(variable.foretold(fem_.GetTime().timeIncrement));
  const double left = has_known_totals(solver) ? part_left : 1;
  std::vector<double> whole = solver.m_ui;  // the prescribed increments
  const std::vector<double> prescribed_left = scaled(whole, left);
  for_each_free_value(fem_, [&](const FreeValue& value) {
    const MatrixXd& change = changes[value.variable];
    whole[value.equation] = change.size() == 0 ? 0 : change(value.row, value.node);
  });
  solver.m_Ui = whole;
  std::fill(solver.m_ui.begin(), solver.m_ui.end(), 0.0);
  solver.Update(solver.m_ui);
  decide();
  set_totals(solver, scaled(whole, 1 - left));
  solver.m_ui = prescribed_left;
  part_of_guess_ = scaled(whole, left);
  return true;
}

void StepExtrapolation::complete_residual(FENewtonSolver& solver) {
  if (part_of_guess_.empty()) return;
  // FEBio's right-hand side is R(x + P) and what prescribed increments add. To free values these have added already, in
  // R(x + P).
  std::vector<double> part(part_of_guess_.size(), 0.0);
  for_each_free_value(fem_, [&](const FreeValue& value) {
    part[value.equation] = part_of_guess_[value.equation];
    solver.m_R0[value.equation] -= solver.m_Fd[value.equation];
  });
  part_of_guess_.clear();
  std::vector<double> load(part.size());
  solver.m_pK->GetSparseMatrixPtr()->mult_vector(part.data(), load.data());
  for (std::size_t n = 0; n < load.size(); ++n) solver.m_R0[n] += load[n];
}
