#include "step_extrapolation.h"

#include "archive.h"

#include <Eigen/QR>

#include <FEBioMech/FEMechModel.h>
#include <FECore/DumpStream.h>
#include <FECore/FEGlobalMatrix.h>
#include <FECore/FELoadController.h>
#include <FECore/FEMesh.h>
#include <FECore/FEModel.h>
#include <FECore/FENewtonSolver.h>
#include <FECore/SparseMatrix.h>

#include <limits>
#include <utility>

using Eigen::ArrayXXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr Index highest_degree = 2;
/// What would have been told to this part of its last change is extrapolated.
constexpr double largest_error = 1.0 / 3.0;
/// Polynomials that differ by less than this part are the same: of a motion at constant speed rounding would choose.
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

/// Weights of what polynomials foretold that would have told the actual change best, by least squares: shape (rows of
/// `actual`, highest_degree). Rows of a group have the same; zero where even so too much would have been missed.
MatrixXd best_weights(const std::vector<MatrixXd>& foretold, const MatrixXd& actual,
                      const std::vector<std::vector<int>>& groups) {
  MatrixXd weights = MatrixXd::Zero(actual.rows(), highest_degree);
  const auto degrees = static_cast<Index>(foretold.size());
  if (degrees == 0) return weights;
  for (const std::vector<int>& rows : groups) {
    const VectorXd change = actual(rows, Eigen::all).reshaped();
    MatrixXd told(change.size(), degrees);
    for (Index n = 0; n < degrees; ++n)
      told.col(n) = foretold[static_cast<std::size_t>(n)](rows, Eigen::all).reshaped();
    Eigen::ColPivHouseholderQR<MatrixXd> best;
    best.setThreshold(same_change);
    const VectorXd weight = best.compute(told).solve(change);
    if ((told * weight - change).norm() > largest_error * change.norm()) continue;
    for (const int row : rows) weights.row(row).head(degrees) = weight;
  }
  return weights;
}

MatrixXd weighted(const std::vector<MatrixXd>& foretold, const MatrixXd& weights) {
  MatrixXd sum = MatrixXd::Zero(foretold.front().rows(), foretold.front().cols());
  for (std::size_t n = 0; n < foretold.size(); ++n) {
    sum += weights.col(static_cast<Index>(n)).asDiagonal() * foretold[n];
  }
  return sum;
}

}  // namespace

/// What the polynomials through the last two, three, ... states foretell for a step of length dt.
std::vector<MatrixXd> StepExtrapolation::foretold(MatrixXd Change::* of, double dt) const {
  if (last_.empty()) return {};
  // Newton's form, with divided differences.
  const MatrixXd rate = last_[0].*of / last_[0].dt;
  std::vector<MatrixXd> all{dt * rate};
  if (last_.size() == 1) return all;
  const double span = last_[0].dt + last_[1].dt;
  const MatrixXd bend = (rate - last_[1].*of / last_[1].dt) / span;
  all.emplace_back(dt * (rate + (dt + last_[0].dt) * bend));
  return all;
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
  value_weights_ = best_weights(foretold(&Change::values, actual.dt), actual.values, variables_of(fem_));
  std::vector<std::vector<int>> controllers;
  for (int n = 0; n < fem_.LoadControllers(); ++n) controllers.push_back({n});
  load_weights_ = best_weights(foretold(&Change::loads, actual.dt), actual.loads, controllers);
  const bool tried_in_vain = iterations_plain_ <= least_iterations && iterations_ahead_ >= iterations_plain_;
  if (iterations_plain_ == 1 || tried_in_vain) value_weights_.setZero();
  last_.insert(last_.begin(), std::move(actual));
  if (last_.size() > highest_degree) last_.pop_back();
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
  const ArrayXXd expected = weighted(foretold(&Change::loads, fem_.GetTime().timeIncrement), load_weights_);
  return ((expected - actual).abs() > largest_error * actual.abs() + rounding * loads.abs()).any();
}

bool StepExtrapolation::begins_ahead() const {
  return !value_weights_.isZero(0) && analysis_step_ == fem_.GetCurrentStepIndex() && !loads_turn();
}

bool StepExtrapolation::move_to_expected_state(FENewtonSolver& solver, const std::function<void()>& decide) {
  ahead_ = begins_ahead();
  if (!ahead_) return false;
  const MatrixXd change = weighted(foretold(&Change::values, fem_.GetTime().timeIncrement), value_weights_);
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
