#include "febio_system.h"

#include "back_substitution.h"

#include <FECore/Callback.h>
#include <FECore/FEException.h>
#include <FECore/FEGlobalMatrix.h>
#include <FECore/FEModel.h>
#include <FECore/FEModifiedNewtonStrategy.h>
#include <FECore/FENewtonSolver.h>
#include <FECore/FENewtonStrategy.h>
#include <FECore/JFNKStrategy.h>
#include <FECore/LinearSolver.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace newton {

double FEBioSystem::increment_tolerance() const {
  double smallest = std::numeric_limits<double>::infinity();
  for (const char* name : {"dtol", "ptol", "ctol"}) {  // displacements, pressures, concentrations
    const FEParam* const parameter = solver_.febio()->GetParameter(name);
    if (parameter == nullptr || parameter->type() != FE_PARAM_DOUBLE) continue;
    const double tolerance = parameter->value<double>();
    if (tolerance > 0) smallest = std::min(smallest, tolerance);
  }
  return smallest;
}

// ------------------------------------------------------------ the system of equations

FEGlobalMatrix& FEBioSystem::matrix() const { return *solver_.febio()->m_pK; }

Eigen::MatrixXd FEBioSystem::solve(Eigen::MatrixXd rights) const {
  return back_substitute(*solver_.febio()->GetLinearSolver(), std::move(rights));
}

void FEBioSystem::factorise() const {
  if (!solver_.febio()->GetLinearSolver()->Factor()) throw FactorizationError();
}

void FEBioSystem::form_matrix() const {
  if (!solver_.febio()->m_qnstrategy->ReformStiffness()) throw FactorizationError();
  solver_.febio()->GetFEModel()->DoCallback(CB_MATRIX_REFORM);
}

void FEBioSystem::renew_residual() const { solver_.febio()->Residual(solver_.febio()->m_R0); }

void FEBioSystem::keep_profile() const { solver_.febio()->m_breshape = false; }

MatrixStrategy FEBioSystem::strategy() const {
  const FENewtonSolver* const solver = solver_.febio();
  const FENewtonStrategy* const strategy = solver == nullptr ? nullptr : solver->m_qnstrategy;
  if (strategy == nullptr) return MatrixStrategy::none;
  if (const auto* differences = dynamic_cast<const JFNKStrategy*>(strategy))
    return differences->m_bprecondition ? MatrixStrategy::preconditioner : MatrixStrategy::residuals_alone;
  const bool is_modified = dynamic_cast<const FEModifiedNewtonStrategy*>(strategy) != nullptr;
  return is_modified ? MatrixStrategy::unchanged : MatrixStrategy::updated;
}

int FEBioSystem::matrices() const { return solver_.febio()->m_ntotref; }
int FEBioSystem::most_matrices() const { return solver_.febio()->m_maxref; }
bool FEBioSystem::may_form_matrix() const { return solver_.febio()->m_nref < solver_.febio()->m_maxref; }
int FEBioSystem::updates() const { return solver_.febio()->m_qnstrategy->m_nups; }
int FEBioSystem::most_updates() const { return solver_.febio()->m_qnstrategy->m_maxups; }
int FEBioSystem::drop_updates() const { return std::exchange(solver_.febio()->m_qnstrategy->m_nups, 0); }
bool FEBioSystem::is_matrix_forced() const { return solver_.febio()->m_bforceReform; }
void FEBioSystem::force_matrix(bool is_forced) const { solver_.febio()->QNForceReform(is_forced); }
bool& FEBioSystem::forms_matrix_after_augmentations() const { return solver_.febio()->m_breformAugment; }

}  // namespace newton
