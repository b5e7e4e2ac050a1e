#include "matrix_requests.h"

#include "host/linear_solvers.h"
#include "solver/febio/febio_system.h"

#include <FECore/FEAnalysis.h>
#include <FECore/FECoreKernel.h>
#include <FECore/FENewtonSolver.h>
#include <FECore/LinearSolver.h>

#include <string>

namespace {

/// The Newton solver of a step of the analysis; null if the step has another kind of solver.
FENewtonSolver* newton_solver(FEModel& model, int step) {
  return dynamic_cast<FENewtonSolver*>(model.GetStep(step)->GetFESolver());
}

/// The type of a solver's linear solver.
std::string linear_solver_type(FENewtonSolver& solver) {
  LinearSolver* const chosen = solver.GetLinearSolver();
  return chosen == nullptr ? FECoreKernel::GetInstance().GetLinearSolverType() : chosen->GetTypeStr();
}

}  // namespace

void ask_for_nonsymmetric_matrix(FEModel& model, const ContactLog& log) {
  for (int i = model.GetCurrentStepIndex(); i < model.Steps(); ++i) {
    FENewtonSolver* const solver = newton_solver(model, i);
    if (solver == nullptr || solver->m_msymm != REAL_SYMMETRIC) continue;
    solver->m_msymm = REAL_UNSYMMETRIC;
    log.say("the matrix of step " + std::to_string(i + 1) +
            " is set to non-symmetric, because the matrix of this contact is. "
            "<symmetric_stiffness>1</symmetric_stiffness> in the contact keeps it symmetric, with slower convergence.");
  }
}

bool takes_any_structure(FEModel& model) {
  const FENewtonSolver* const solver = newton_solver(model, model.GetCurrentStepIndex());
  // A matrix set to be symmetric is made non-symmetric. The setting "preferred" may lead to a symmetric structure.
  return solver != nullptr && (solver->m_msymm == REAL_UNSYMMETRIC || solver->m_msymm == REAL_SYMMETRIC);
}

bool takes_mixed_form(FEModel& model) {
  FENewtonSolver* const solver = newton_solver(model, model.GetCurrentStepIndex());
  using newton::MatrixStrategy;
  newton::FEBioSolver present(model);
  const MatrixStrategy strategy = newton::FEBioSystem(present).strategy();
  if (solver == nullptr || strategy == MatrixStrategy::preconditioner || strategy == MatrixStrategy::residuals_alone)
    return false;
  // For matrices of symmetric structure, pardiso neither scales rows nor matches pivots.
  return takes_any_structure(model) && takes_mixed_form(linear_solver_type(*solver));
}

void judge_linear_solver(FEModel& model, bool has_unknown_multipliers, const ContactLog& log) {
  for (int i = model.GetCurrentStepIndex(); i < model.Steps(); ++i) {
    FENewtonSolver* const solver = newton_solver(model, i);
    if (solver == nullptr) continue;
    const MatrixKind matrix{solver->m_msymm == REAL_SYMMETRIC, has_unknown_multipliers};
    const std::string complaint = linear_solver_complaint(linear_solver_type(*solver), matrix);
    if (!complaint.empty()) return log.say(complaint);
  }
}
