#include "kept_matrix.h"

#include <FECore/FEException.h>
#include <FECore/FEModifiedNewtonStrategy.h>
#include <FECore/FENewtonSolver.h>
#include <FECore/FENewtonStrategy.h>
#include <FECore/LinearSolver.h>

#include <algorithm>
#include <utility>

void KeptMatrix::formed() {
  number_ = solver_.febio()->m_ntotref;
  released_.forget();
  iterations_ = 0;
  may_correct_ = true;
}

void KeptMatrix::follow() {
  if (number_ != solver_.febio()->m_ntotref) formed();
}

bool KeptMatrix::is_due() {
  follow();
  const FENewtonStrategy& strategy = *solver_.febio()->m_qnstrategy;
  const bool has_limit = strategy.m_maxups > 0 && dynamic_cast<const FEModifiedNewtonStrategy*>(&strategy) == nullptr;
  return !may_correct_ || (has_limit && iterations_ >= strategy.m_maxups - 1);
}

void KeptMatrix::correct(const std::vector<int>& released) {
  follow();
  FENewtonSolver& solver = *solver_.febio();
  // Those of BFGS are for symmetric matrices, and would spoil the stiffness that corrected gaps are closed with; those
  // of Broyden have solved for the residual before the correction.
  iterations_ += std::max(1, std::exchange(solver.m_qnstrategy->m_nups, 0));
  const auto solve = [&](std::vector<double> right) {
    std::vector<double> solution(right.size());
    if (!solver.GetLinearSolver()->BackSolve(solution, right)) throw LinearSolverFailed();
    return solution;
  };
  may_correct_ = released_.hold(solve, released, solver.m_R0);
}

void KeptMatrix::reject(mixture_contact::GoesOn with) {
  if (with == mixture_contact::GoesOn::correction) return accept();
  // Other nodes are in contact now: quasi-Newton methods would go on with the matrix of those that were.
  if (!reform_augment_) reform_augment_ = std::exchange(solver_.febio()->m_breformAugment, true);
}

void KeptMatrix::accept() {
  const std::optional<bool> own = std::exchange(reform_augment_, std::nullopt);
  if (own) solver_.febio()->m_breformAugment = *own;
}
