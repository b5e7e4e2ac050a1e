#include "first_norms.h"

#include <FEBioMech/FEResidualVector.h>
#include <FECore/FEModel.h>
#include <FECore/FENewtonSolver.h>
#include <FECore/vector.h>

#include <algorithm>
#include <cmath>
#include <utility>

FirstNorms::FirstNorms(FEModel& fem, newton::FEBioSolver& solver, ActiveContacts contacts, newton::DeviceRecord& record)
    : fem_(fem), solver_(solver), contacts_(std::move(contacts)), record_(record) {}

void FirstNorms::begin_step() {
  awaits_residual_ = true;
  residual_.clear();
}

void FirstNorms::complete_residual() {
  if (!std::exchange(awaits_residual_, false)) return;
  std::vector<double>& first = solver_.febio()->m_R0;
  std::vector<double> ahead(first.size());
  std::vector<double> reactions(first.size());
  FEResidualVector vector(fem_, ahead, reactions);
  for (const ContactInModel* contact : contacts_())
    contact->assembly().residual_ahead(vector, solver_.time_increment());
  const auto is_zero = [](double entry) { return entry == 0; };
  if (std::all_of(ahead.begin(), ahead.end(), is_zero)) return;
  residual_ = first - ahead;
  record_.acted(newton::Device::expected_contact);
}

void FirstNorms::try_increment(const std::vector<double>& /*increment*/) {
  // FEBio measures by the increment that it has solved for, whatever part of it a line search tries.
  const FENewtonSolver& solver = *solver_.febio();
  if (solver.m_niter == 0 && !residual_.empty()) energy_ = std::abs(solver.m_ui * residual_);
}

bool FirstNorms::is_settled() const {
  if (residual_.empty()) return true;
  FENewtonSolver& solver = *solver_.febio();
  const double residual = solver.GetResidualConvergence().norm;
  if (residual < solver.m_Rmin) return true;  // no force is left: FEBio accepts that whatever its tolerances
  const bool meets_residual = solver.m_Rtol <= 0 || residual <= solver.m_Rtol * (residual_ * residual_);
  const bool meets_energy = solver.m_Etol <= 0 || solver.GetEnergyConvergence().norm <= solver.m_Etol * energy_;
  return meets_residual && meets_energy;
}
