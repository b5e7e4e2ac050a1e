#include "present_step.h"

#include <FEBioMech/FEExplicitSolidSolver.h>
#include <FEBioMech/FESolidAnalysis.h>
#include <FEBioMech/FESolidSolver2.h>
#include <FEBioMix/FEBiphasicAnalysis.h>
#include <FECore/FEAnalysis.h>
#include <FECore/FEModel.h>
#include <FECore/FENewtonSolver.h>

SolverKind solver_kind_of(FEModel& fem) {
  const FESolver* const solver = fem.GetCurrentStep()->GetFESolver();
  if (dynamic_cast<const FENewtonSolver*>(solver) != nullptr) return SolverKind::newton;
  const auto* dynamics = dynamic_cast<const FEExplicitSolidSolver*>(solver);
  return dynamics == nullptr ? SolverKind::conjugate_gradient : SolverKind::explicit_dynamics;
}

bool has_inertia(FEModel& fem) {
  FEAnalysis& step = *fem.GetCurrentStep();
  return step.m_nanalysis == FESolidAnalysis::DYNAMIC &&
         dynamic_cast<const FESolidSolver2*>(step.GetFESolver()) != nullptr;
}

double storing_time_step(FEModel& fem) {
  const bool stores = fem.GetCurrentStep()->m_nanalysis == FEBiphasicAnalysis::TRANSIENT;
  return stores ? fem.GetTime().timeIncrement : 0;
}
