#include "febio_solver.h"

#include "solver_totals.h"

#include <FEBioMech/FEMechModel.h>
#include <FEBioMech/FESolidSolver2.h>
#include <FEBioMix/FEBiphasicSoluteSolver.h>
#include <FEBioMix/FEMultiphasicSolver.h>
#include <FECore/DumpMemStream.h>
#include <FECore/FEAnalysis.h>
#include <FECore/FEException.h>
#include <FECore/FEGlobalMatrix.h>
#include <FECore/FELineSearch.h>
#include <FECore/FELoadController.h>
#include <FECore/FEMesh.h>
#include <FECore/FEModel.h>
#include <FECore/SparseMatrix.h>
#include <FECore/log.h>

#include <algorithm>
#include <utility>

namespace newton {

FEBioSolver::FEBioSolver(FEModel& fem) : fem_(fem) {}
FEBioSolver::~FEBioSolver() = default;

FENewtonSolver* FEBioSolver::febio() const {
  FEAnalysis* const step = fem_.GetCurrentStep();
  return step == nullptr ? nullptr : dynamic_cast<FENewtonSolver*>(step->GetFESolver());
}

// ------------------------------------------------------------ nodal values

int FEBioSolver::nodes() const { return fem_.GetMesh().Nodes(); }

std::vector<std::vector<int>> FEBioSolver::variables() const {
  DOFS& dofs = fem_.GetDOFS();
  std::vector<std::vector<int>> variables;
  for (int n = 0; n < dofs.Variables(); ++n) {
    std::vector<int> of_one;
    dofs.GetDOFList(n, of_one);
    if (dofs.GetVariableType(n) == VAR_ARRAY) {
      for (const int dof : of_one) variables.emplace_back(1, dof);
    } else {
      variables.push_back(std::move(of_one));
    }
  }
  return variables;
}

std::size_t FEBioSolver::displacements() const {
  const int dof = fem_.GetDOFIndex("x");
  std::size_t variable = 0;
  for (const std::vector<int>& dofs : variables()) {
    if (std::find(dofs.begin(), dofs.end(), dof) != dofs.end()) break;
    ++variable;
  }
  return variable;
}

std::vector<int> FEBioSolver::concentrations() const {
  std::vector<int> dofs;
  const int solutes = fem_.GetDOFS().GetVariableSize("concentration");
  for (int k = 0; k < solutes; ++k) dofs.push_back(fem_.GetDOFIndex("concentration", k));
  return dofs;
}

int FEBioSolver::equation(Place place) const { return at(fem_.GetMesh().Node(place.node).m_ID, place.dof); }
void FEBioSolver::set_equation(Place place, int code) { at(fem_.GetMesh().Node(place.node).m_ID, place.dof) = code; }
double FEBioSolver::value(Place place) const { return fem_.GetMesh().Node(place.node).get(place.dof); }
void FEBioSolver::set_value(Place place, double value) { fem_.GetMesh().Node(place.node).set(place.dof, value); }
double FEBioSolver::previous_value(Place place) const { return fem_.GetMesh().Node(place.node).get_prev(place.dof); }

// ------------------------------------------------------------ the solver

Vectors FEBioSolver::vectors() {
  FENewtonSolver& solver = *febio();
  return {solver.m_Ut, solver.m_Ui, solver.m_ui, solver.m_R0, solver.m_Fd};
}

void FEBioSolver::update(std::vector<double>& increment) {
  try {
    febio()->Update(increment);
  } catch (const NegativeJacobianDetected&) {
    throw InvertedElement();
  } catch (const NegativeJacobian&) {
    throw InvertedElement();
  }
}

std::vector<double> FEBioSolver::evaluate_residual() {
  std::vector<double> residual(febio()->m_R0.size());
  febio()->Residual(residual);
  return residual;
}

std::vector<double> FEBioSolver::times_matrix(const std::vector<double>& vector) const {
  std::vector<double> factor = vector;
  std::vector<double> product(vector.size());
  febio()->m_pK->GetSparseMatrixPtr()->mult_vector(factor.data(), product.data());
  return product;
}

bool FEBioSolver::has_known_totals() const { return ::has_known_totals(*febio()); }
void FEBioSolver::set_totals(const std::vector<double>& change) { ::set_totals(*febio(), change); }

const std::vector<double>* FEBioSolver::reactions_of_clamp() const {
  if (const auto* solute = dynamic_cast<const FEBiphasicSoluteSolver*>(febio())) return &solute->m_Fr;
  const auto* multiphasic = dynamic_cast<const FEMultiphasicSolver*>(febio());
  return multiphasic != nullptr && multiphasic->m_forcePositive ? &multiphasic->m_Fr : nullptr;
}

Solver::LineSearch FEBioSolver::line_search() {
  FELineSearch* const search = febio()->GetLineSearch();
  return search == nullptr ? LineSearch() : LineSearch{&search->m_LStol, &search->m_checkJacobians};
}

Solver::ResidualSquares FEBioSolver::residual_squares() {
  const ConvergenceInfo residual = febio()->GetResidualConvergence();
  auto* const solids = dynamic_cast<FESolidSolver2*>(febio());
  return {residual.norm, residual.norm0, solids == nullptr ? nullptr : &solids->m_Rmin};
}

int FEBioSolver::iterations() const { return febio()->m_niter; }

// ------------------------------------------------------------ the model

bool FEBioSolver::is_predictable() const {
  // Rigid bodies move by unknowns of their own, and the arc-length method determines the loads itself.
  const auto* mechanics = dynamic_cast<const FEMechModel*>(&fem_);
  const auto* solids = dynamic_cast<const FESolidSolver2*>(febio());
  return (mechanics == nullptr || mechanics->RigidBodies() == 0) && (solids == nullptr || solids->m_arcLength == 0);
}

double FEBioSolver::time_increment() const { return fem_.GetTime().timeIncrement; }
int FEBioSolver::analysis_step() const { return fem_.GetCurrentStepIndex(); }

std::vector<double> FEBioSolver::load_values() const {
  std::vector<double> values;
  for (int n = 0; n < fem_.LoadControllers(); ++n) values.push_back(fem_.GetLoadController(n)->Value());
  return values;
}

void FEBioSolver::save_state() {
  // FEBio saves the state for repeated steps in the same way.
  saved_ = std::make_unique<DumpMemStream>(fem_);
  fem_.Serialize(*saved_);
  forces_matrix_ = febio()->m_bforceReform;
}

void FEBioSolver::restore_state() {
  saved_->Open(false, true);
  fem_.Serialize(*saved_);
  febio()->m_bforceReform = forces_matrix_;
}

void FEBioSolver::log(const std::string& line) const { feLogEx(&fem_, "%s\n", line.c_str()); }

}  // namespace newton
