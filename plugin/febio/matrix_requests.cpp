#include "matrix_requests.h"

#include "host/linear_solvers.h"

#include <FECore/FEAnalysis.h>
#include <FECore/FECoreKernel.h>
#include <FECore/FENewtonSolver.h>
#include <FECore/LinearSolver.h>

#include <string>

namespace {

/// That of a step of the analysis; null where it is none of Newton's kind.
FENewtonSolver* newton_solver(FEModel& model, int step) {
  return dynamic_cast<FENewtonSolver*>(model.GetStep(step)->GetFESolver());
}

}  // namespace

void ask_for_nonsymmetric_matrix(FEModel& model, const ContactLog& log) {
  for (int i = model.GetCurrentStepIndex(); i < model.Steps(); ++i) {
    FENewtonSolver* const solver = newton_solver(model, i);
    if (solver == nullptr || solver->m_msymm != REAL_SYMMETRIC) continue;
    solver->m_msymm = REAL_UNSYMMETRIC;
    log.say("the matrix of step " + std::to_string(i + 1) +
            " is set to non-symmetric, as that of this contact is. To keep it symmetric set "
            "<symmetric_stiffness>1</symmetric_stiffness> in the contact; convergence is slower then.");
  }
}

void judge_linear_solver(FEModel& model, bool has_unknown_multipliers, const ContactLog& log) {
  for (int i = model.GetCurrentStepIndex(); i < model.Steps(); ++i) {
    FENewtonSolver* const solver = newton_solver(model, i);
    if (solver == nullptr) continue;
    LinearSolver* const chosen = solver->GetLinearSolver();
    const std::string type = chosen == nullptr ? FECoreKernel::GetInstance().GetLinearSolverType()
                                               : chosen->GetTypeStr();
    const MatrixKind matrix{solver->m_msymm == REAL_SYMMETRIC, has_unknown_multipliers};
    const std::string complaint = linear_solver_complaint(type, matrix);
    if (!complaint.empty()) return log.say(complaint);
  }
}
