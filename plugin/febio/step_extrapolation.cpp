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

constexpr std::size_t changes_kept = 2;
/// What would have been told to this part of its last change is extrapolated.
constexpr double largest_error = 1.0 / 3.0;
/// A parabola that differs from the line by less than this part is one: of a motion at constant speed rounding would
/// decide.
constexpr double same_change = 1e-6;
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
  MatrixXd values(fem.LoadControllers(), 1);
  for (Index n = 0; n < values.size(); ++n) values(n) = fem.GetLoadController(static_cast<int>(n))->Value();
  return values;
}

/// Degrees of freedom of each variable (displacement, pressure, concentration).
std::vector<std::vector<int>> variables_of(FEModel& fem) {
  DOFS& dofs = fem.GetDOFS();
  std::vector<std::vector<int>> variables(static_cast<std::size_t>(dofs.Variables()));
  for (std::size_t n = 0; n < variables.size(); ++n) dofs.GetDOFList(static_cast<int>(n), variables[n]);
  return variables;
}

}  // namespace

/// Weights of the line and of what a parabola adds to it, shape (rows of the change, 2): 1 and the part from 0 to 1
/// that would have told the change best, for the rows of each group together; zeros where even so too much was missed.
MatrixXd StepExtrapolation::best_weights(const Foretold& told, const MatrixXd& change,
                                         const std::vector<std::vector<int>>& groups) {
  MatrixXd weights = MatrixXd::Zero(change.rows(), 2);
  for (const std::vector<int>& rows : groups) {
    const MatrixXd line = told.line(rows, Eigen::all);
    const MatrixXd bend = told.bend(rows, Eigen::all);
    const MatrixXd whole = change(rows, Eigen::all);
    const MatrixXd missed = whole - line;
    const bool is_line = bend.norm() <= same_change * line.norm();
    const double part = is_line ? 0.0 : std::clamp(bend.cwiseProduct(missed).sum() / bend.squaredNorm(), 0.0, 1.0);
    if ((missed - part * bend).norm() > largest_error * whole.norm()) continue;
    for (const int row : rows) weights.row(row) << 1, part;
  }
  return weights;
}

MatrixXd StepExtrapolation::expected(const Foretold& told, const MatrixXd& weights) {
  return weights.col(0).asDiagonal() * told.line + weights.col(1).asDiagonal() * told.bend;
}

StepExtrapolation::Foretold StepExtrapolation::foretold(MatrixXd Change::* of, double dt) const {
  // Newton's form of the polynomials, with divided differences.
  const MatrixXd rate = last_[0].*of / last_[0].dt;
  if (last_.size() == 1) return {dt * rate, MatrixXd::Zero(rate.rows(), rate.cols())};
  const double span = last_[0].dt + last_[1].dt;
  return {dt * rate, dt * (dt + last_[0].dt) / span * (rate - last_[1].*of / last_[1].dt)};
}

bool StepExtrapolation::is_available(FEModel& fem) {
  const auto* mechanics = dynamic_cast<const FEMechModel*>(&fem);
  return mechanics == nullptr || mechanics->RigidBodies() == 0;
}

void StepExtrapolation::choose_weights(const Change& actual) {
  value_weights_.setZero();
  const bool tried_in_vain = iterations_plain_ <= least_iterations && iterations_ahead_ >= iterations_plain_;
  if (last_.empty() || iterations_plain_ == 1 || tried_in_vain) return;
  value_weights_ = best_weights(foretold(&Change::values, actual.dt), actual.values, variables_of(fem_));
  std::vector<std::vector<int>> controllers;
  for (int n = 0; n < fem_.LoadControllers(); ++n) controllers.push_back({n});
  load_weights_ = best_weights(foretold(&Change::loads, actual.dt), actual.loads, controllers);
  // A variable that is not foretold stays where it is. If displacements do, those that are prescribed would squeeze the
  // elements beside them; and where all that changed stays, there is nothing to gain.
  const bool moves = value_weights_(fem_.GetDOFIndex("x"), 0) > 0;
  const MatrixXd followed = value_weights_.col(0).asDiagonal() * actual.values;
  if (!moves || followed.isZero(0)) value_weights_.setZero();
}

void StepExtrapolation::step_solved(int iterations) {
  (std::exchange(ahead_, false) ? iterations_ahead_ : iterations_plain_) = iterations;
  if (std::exchange(analysis_step_, fem_.GetCurrentStepIndex()) != fem_.GetCurrentStepIndex()) last_.clear();
  const MatrixXd before = std::exchange(loads_, load_values(fem_));
  if (before.size() != loads_.size()) return;  // the first step: what the loads were at its start is not known
  Change actual{changes_of_step(fem_), loads_ - before, fem_.GetTime().timeIncrement};
  choose_weights(actual);
  last_.insert(last_.begin(), std::move(actual));
  if (last_.size() > changes_kept) last_.pop_back();
}

void StepExtrapolation::serialize(DumpStream& ar) {
  if (ar.IsShallow()) {
    if (ar.IsSaving()) return;
    first_guess_.clear();
    value_weights_.setZero();
    ahead_ = false;
    return;
  }
  int changes = static_cast<int>(last_.size());
  ar & analysis_step_ & changes & iterations_ahead_ & iterations_plain_;
  archive(ar, loads_);
  archive(ar, value_weights_);
  archive(ar, load_weights_);
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
  const ArrayXXd told = expected(foretold(&Change::loads, fem_.GetTime().timeIncrement), load_weights_);
  return ((told - actual).abs() > largest_error * actual.abs() + rounding * loads.abs()).any();
}

bool StepExtrapolation::begins_ahead() const {
  return (value_weights_.array() != 0).any() && analysis_step_ == fem_.GetCurrentStepIndex() && !loads_turn();
}

bool StepExtrapolation::move_to_expected_state(FENewtonSolver& solver, const std::function<void()>& decide) {
  ahead_ = begins_ahead();
  if (!ahead_) return false;
  const MatrixXd change = expected(foretold(&Change::values, fem_.GetTime().timeIncrement), value_weights_);
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
