#include "step_extrapolation.h"

#include <FECore/FEGlobalMatrix.h>
#include <FECore/FEMesh.h>
#include <FECore/FEModel.h>
#include <FECore/FENewtonSolver.h>
#include <FECore/SparseMatrix.h>

#include <algorithm>
#include <limits>

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

constexpr int highest_order = 2;
/// Extrapolation starts a step where it would have told the change of the last one to this part.
constexpr double largest_error = 1.0 / 3.0;

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

}  // namespace

MatrixXd StepExtrapolation::expected(int order, double dt) const {
  // Newton's form of the polynomial through the last states, with divided differences.
  const MatrixXd rate = last_[0].values / last_[0].dt;
  if (order == 1) return dt * rate;
  const double span = last_[0].dt + last_[1].dt;
  const MatrixXd bend = (rate - last_[1].values / last_[1].dt) / span;
  return dt * (rate + (dt + last_[0].dt) * bend);
}

double StepExtrapolation::worst_error(const Change& actual, int order) const {
  // Each variable (displacement, pressure, concentration) by itself, since their units differ.
  const MatrixXd error = expected(order, actual.dt) - actual.values;
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
    if (error >= least) continue;
    least = error;
    order_ = order;
  }
}

void StepExtrapolation::step_solved() {
  Change actual{changes_of_step(fem_), fem_.GetTime().timeIncrement};
  choose_order(actual);
  last_.insert(last_.begin(), std::move(actual));
  if (last_.size() > highest_order) last_.pop_back();
}

void StepExtrapolation::skip() {
  first_guess_.clear();
  order_ = 0;
}

bool StepExtrapolation::move_to_expected_state(FENewtonSolver& solver, const std::function<void()>& decide) {
  if (order_ == 0) return false;
  const MatrixXd change = expected(order_, fem_.GetTime().timeIncrement);
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
