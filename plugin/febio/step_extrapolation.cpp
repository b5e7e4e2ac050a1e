#include "step_extrapolation.h"

#include "archive.h"

#include <FEBioMech/FEMechModel.h>
#include <FECore/DumpStream.h>
#include <FECore/FEGlobalMatrix.h>
#include <FECore/FELoadController.h>
#include <FECore/FEMesh.h>
#include <FECore/FEModel.h>
#include <FECore/FENewtonSolver.h>
#include <FECore/SparseMatrix.h>

#include <algorithm>
#include <limits>
#include <utility>

using Eigen::ArrayXXd;
using Eigen::Index;
using Eigen::MatrixXd;

namespace {

constexpr int highest_order = 2;
/// Extrapolation starts a step where it would have told the change of the last one to this part.
constexpr double largest_error = 1.0 / 3.0;
/// Polynomials whose errors differ by less than this part of the change are as good as each other, and the lower one is
/// taken: of a motion at constant speed rounding would choose.
constexpr double same_error = 1e-6;
/// Of the differences of load values of 1, extrapolated.
constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
/// FEBio compares increments with the first one of a step, and so takes two, but where the residual vanishes.
constexpr int least_iterations = 2;

/// Calls `use` with the equation, the degree of freedom and the node (index) of every free nodal value.
template <class Use>
void for_each_free_value(FEModel& fem, const Use& use) {
  FEMesh& mesh = fem.GetMesh();
  for (int i = 0; i < mesh.Nodes(); ++i) {
    const std::vector<int>& equations = mesh.Node(i).m_ID;
    for (std::size_t dof = 0; dof < equations.size(); ++dof) {
      if (equations[dof] >= 0) use(static_cast<std::size_t>(equations[dof]), static_cast<Index>(dof), Index{i});
    }
  }
}

/// Changes of the free values; zero elsewhere.
MatrixXd changes_of_step(FEModel& fem) {
  FEMesh& mesh = fem.GetMesh();
  MatrixXd change = MatrixXd::Zero(fem.GetDOFS().GetTotalDOFS(), mesh.Nodes());
  for_each_free_value(fem, [&](std::size_t, Index dof, Index node) {
    const FENode& place = mesh.Node(static_cast<int>(node));
    change(dof, node) = place.get(static_cast<int>(dof)) - place.get_prev(static_cast<int>(dof));
  });
  return change;
}

MatrixXd load_values(FEModel& fem) {
  MatrixXd values(1, fem.LoadControllers());
  for (Index n = 0; n < values.size(); ++n) values(n) = fem.GetLoadController(static_cast<int>(n))->Value();
  return values;
}

}  // namespace

MatrixXd StepExtrapolation::expected(MatrixXd Change::* of, int order, double dt) const {
  // Newton's form of the polynomial through the last states, with divided differences.
  const MatrixXd rate = last_[0].*of / last_[0].dt;
  if (order == 1) return dt * rate;
  const double span = last_[0].dt + last_[1].dt;
  const MatrixXd bend = (rate - last_[1].*of / last_[1].dt) / span;
  return dt * (rate + (dt + last_[0].dt) * bend);
}

double StepExtrapolation::worst_error(const Change& actual, int order) const {
  // Each variable (displacement, pressure, concentration) by itself, since their units differ.
  const MatrixXd error = expected(&Change::values, order, actual.dt) - actual.values;
  DOFS& variables = fem_.GetDOFS();
  double worst = 0;
  for (int variable = 0; variable < variables.Variables(); ++variable) {
    std::vector<int> dofs;
    variables.GetDOFList(variable, dofs);
    double missed = 0;
    double whole = 0;
    for (const int dof : dofs) {
      missed += error.row(dof).squaredNorm();
      whole += actual.values.row(dof).squaredNorm();
    }
    if (whole > 0) worst = std::max(worst, missed / whole);
  }
  return std::sqrt(worst);
}

void StepExtrapolation::choose_order(const Change& actual) {
  order_ = 0;
  double least = largest_error;
  for (int order = 1; order <= static_cast<int>(last_.size()); ++order) {
    const double error = worst_error(actual, order);
    if (error >= least - same_error) continue;
    least = error;
    order_ = order;
  }
}

bool StepExtrapolation::is_available(FEModel& fem) {
  const auto* mechanics = dynamic_cast<const FEMechModel*>(&fem);
  return mechanics == nullptr || mechanics->RigidBodies() == 0;
}

void StepExtrapolation::step_solved(int iterations) {
  (std::exchange(ahead_, false) ? iterations_ahead_ : iterations_plain_) = iterations;
  if (std::exchange(analysis_step_, fem_.GetCurrentStepIndex()) != fem_.GetCurrentStepIndex()) last_.clear();
  const MatrixXd before = std::exchange(loads_, load_values(fem_));
  if (before.size() != loads_.size()) return;  // the first step: what the loads were at its start is not known
  Change actual{changes_of_step(fem_), loads_ - before, fem_.GetTime().timeIncrement};
  choose_order(actual);
  const bool tried_in_vain = iterations_plain_ <= least_iterations && iterations_ahead_ >= iterations_plain_;
  if (iterations_plain_ == 1 || tried_in_vain) order_ = 0;
  last_.insert(last_.begin(), std::move(actual));
  if (last_.size() > highest_order) last_.pop_back();
}

void StepExtrapolation::serialize(DumpStream& ar) {
  if (ar.IsShallow()) {
    if (ar.IsSaving()) return;
    first_guess_.clear();
    order_ = 0;
    ahead_ = false;
    return;
  }
  int changes = static_cast<int>(last_.size());
  ar & order_ & analysis_step_ & changes & iterations_ahead_ & iterations_plain_;
  archive(ar, loads_);
  last_.resize(static_cast<std::size_t>(changes));
  for (Change& change : last_) {
    archive(ar, change.values);
    archive(ar, change.loads);
    ar & change.dt;
  }
}

bool StepExtrapolation::loads_turn() const {
  const ArrayXXd loads = load_values(fem_);
  const ArrayXXd actual = loads - loads_.array();
  const ArrayXXd foretold = expected(&Change::loads, order_, fem_.GetTime().timeIncrement);
  return ((foretold - actual).abs() > largest_error * actual.abs() + rounding * loads.abs()).any();
}

bool StepExtrapolation::begins_ahead() const {
  return order_ > 0 && analysis_step_ == fem_.GetCurrentStepIndex() && !loads_turn();
}

bool StepExtrapolation::move_to_expected_state(FENewtonSolver& solver, const std::function<void()>& decide) {
  ahead_ = begins_ahead();
  if (!ahead_) return false;
  const MatrixXd change = expected(&Change::values, order_, fem_.GetTime().timeIncrement);
  first_guess_.assign(solver.m_Ui.size(), 0.0);
  for_each_free_value(fem_,
                      [&](std::size_t equation, Index dof, Index node) { first_guess_[equation] = change(dof, node); });
  std::vector<double> none = solver.m_Ui;
  solver.m_Ui = first_guess_;
  solver.Update(solver.m_ui);  // which holds the prescribed increments
  decide();
  solver.m_Ui = std::move(none);
  return true;
}

void StepExtrapolation::complete_residual(FENewtonSolver& solver) {
  if (first_guess_.empty()) return;
  // FEBio's right-hand side is R(x + p) and what prescribed increments add. To free values these have added already, in
  // R(x + p).
  std::vector<double> guess(first_guess_.size(), 0.0);
  for_each_free_value(fem_, [&](std::size_t equation, Index, Index) {
    guess[equation] = first_guess_[equation];
    solver.m_R0[equation] -= solver.m_Fd[equation];
  });
  first_guess_.clear();
  std::vector<double> load(guess.size());
  solver.m_pK->GetSparseMatrixPtr()->mult_vector(guess.data(), load.data());
  for (std::size_t n = 0; n < load.size(); ++n) solver.m_R0[n] += load[n];
}
