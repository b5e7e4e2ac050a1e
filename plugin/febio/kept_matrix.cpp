#include "kept_matrix.h"

#include <FECore/FEException.h>
#include <FECore/FENewtonSolver.h>
#include <FECore/FENewtonStrategy.h>
#include <FECore/LinearSolver.h>

#include <algorithm>
#include <utility>

void KeptMatrix::formed() {
  released_.forget();
  corrections_ = 0;
  may_correct_ = true;
}

bool KeptMatrix::is_due() const {
  const int most = solver_.febio()->m_qnstrategy->m_maxups;  // 0 where the method has no limit
  return !may_correct_ || (most > 0 && corrections_ >= most - 1);
}

void KeptMatrix::correct(const std::vector<int>& released) {
  FENewtonSolver& solver = *solver_.febio();
  // Those of BFGS are for symmetric matrices: they would spoil the stiffness that corrected gaps are closed with.
  FENewtonStrategy& strategy = *solver.m_qnstrategy;
  strategy.m_nups = std::max(strategy.m_nups - 1, 0);
  ++corrections_;
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
