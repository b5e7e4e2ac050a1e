#include "first_norms.h"

#include "solver/febio/febio_system.h"

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
  std::vector<double>& first = solver_.vectors().residual;
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
  if (solver_.iterations() == 0 && !residual_.empty()) energy_ = std::abs(solver_.vectors().increment * residual_);
}

bool FirstNorms::is_settled() const {
  if (residual_.empty()) return true;
  const newton::ResidualTolerances tolerances = newton::FEBioSystem(fem_, solver_).residual_tolerances();
  const double residual = solver_.residual_squares().now;
  if (residual < tolerances.least_residual) return true;  // FEBio accepts that whatever its other tolerances
  const bool meets_residual = tolerances.residual <= 0 || residual <= tolerances.residual * (residual_ * residual_);
  const double energy = solver_.febio()->GetEnergyConvergence().norm;
  const bool meets_energy = tolerances.energy <= 0 || energy <= tolerances.energy * energy_;
  return meets_residual && meets_energy;
}
