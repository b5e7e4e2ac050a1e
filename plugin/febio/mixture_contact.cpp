#include "mixture_contact.h"

#include "host/augmentation.h"
#include "host/price.h"
#include "host/warnings.h"

#include <FEBioMech/FEMechModel.h>
#include <FECore/FEAnalysis.h>
#include <FECore/FEException.h>
#include <FECore/FEModel.h>
#include <FECore/FESolver.h>
#include <FECore/log.h>

#include <algorithm>
#include <utility>

using namespace mixture_contact;

namespace {

const char* unit_of(Unit unit) {
  if (unit == Unit::length) return UNIT_LENGTH;
  return unit == Unit::pressure ? UNIT_PRESSURE : UNIT_CONCENTRATION;
}

}  // namespace

BEGIN_FECORE_CLASS(FEMixtureContact, FEContactInterface)
  for_each_parameter(parameters_, [this](const ParameterTag& tag, auto& value) {
    FEParam* parameter = AddParameter(value, tag.name);
    parameter->SetWatchVariable(tag.given);
    if (tag.choices != nullptr) parameter->setEnums(tag.choices);
    if (tag.unit != Unit::none) parameter->setUnits(unit_of(tag.unit));
  });
  ADD_PARAMETER(parameters_.ambient_pressure, "ambient_pressure")->setUnits(UNIT_PRESSURE);
  ADD_PROPERTY(ambient_concentrations_, "ambient_concentration", FEProperty::Optional)
      ->SetDefaultType("mixture_ambient_concentration");
END_FECORE_CLASS()

FEMixtureContact::FEMixtureContact(FEModel* fem)
    : FEContactInterface(fem),
      primary_(fem, *this),
      secondary_(fem, *this),
      ambient_(*fem),
      clamped_(*fem),
      extrapolation_(*fem) {
  // Whatever the user's enforcement, FEBio is to ask Augment() before it accepts a solution.
  m_laugon = FECore::AUGLAG_METHOD;
  SetID(fem->SurfacePairConstraints() + 1);
  primary_.SetSibling(&secondary_);
  secondary_.SetSibling(&primary_);
  primary_.SetContactInterface(this);
  secondary_.SetContactInterface(this);
}

// ------------------------------------------------------------ setting up

bool FEMixtureContact::Init() {
  FEModel& fem = *GetFEModel();
  displacement_dofs_ = {fem.GetDOFIndex("x"), fem.GetDOFIndex("y"), fem.GetDOFIndex("z")};
  pressure_dof_ = fem.GetDOFIndex("p");
  concentration_dof_ = fem.GetDOFIndex("concentration", 0);
  concentrations_ = std::max(0, fem.GetDOFS().GetVariableSize("concentration"));
  if (!check_parameters()) return false;
  for (const Side side : both_sides) {
    if (!surface(side).Init()) return false;
  }
  if (parameters_.flip_primary) primary_.turn_round();
  if (parameters_.flip_secondary) secondary_.turn_round();
  if (!check_surfaces() || !read_materials() || !check_ambient()) return false;
  add_callbacks();
  return true;
}

void FEMixtureContact::add_callbacks() {
  if (has_callbacks_) return;
  GetFEModel()->AddCallback(on_step_solved, CB_TIMESTEP_SOLVED, this);
  GetFEModel()->AddCallback(on_matrix_reformed, CB_MATRIX_REFORM, this);
  GetFEModel()->AddCallback(on_solved, CB_SOLVED, this);
  has_callbacks_ = true;
}

bool FEMixtureContact::have_sound_values() {
  const std::vector<std::string> wrong = complaints(parameters_);
  for (const std::string& sentence : wrong)
    feLogError("sliding-mixture \"%s\": %s", GetName().c_str(), sentence.c_str());
  return wrong.empty();
}

bool FEMixtureContact::follow_load_curves() {
  if (!have_sound_values() || !check_ambient()) return false;
  core_->update_laws(core_settings(parameters_, solver_kind()));
  return true;
}

bool FEMixtureContact::check_parameters() {
  const bool sound = have_sound_values();
  for (const std::string& sentence : notices(parameters_))
    feLog("sliding-mixture \"%s\": %s\n", GetName().c_str(), sentence.c_str());
  if (m_psf != 1 || m_psfmax != 0)
    feLog("sliding-mixture \"%s\": <penalty_sf> and <max_penalty_sf> have no effect: penalties grow by themselves.\n",
          GetName().c_str());
  const bool unfit = parameters_.extrapolation && parameters_.extrapolation_given &&
                     !StepExtrapolation::is_available(*GetFEModel());
  if (unfit)
    feLogError("sliding-mixture \"%s\": <extrapolation> is not available in models with rigid bodies; set it to 0.",
               GetName().c_str());
  return sound && !unfit;
}

void FEMixtureContact::Activate() {
  FEContactInterface::Activate();
  if (parameters_.node_reloc && !relocated_) relocate_nodes();
  core_->update_laws(core_settings(parameters_, solver_kind()));
  update_properties();
  ask_for_nonsymmetric_matrix();
  Update();
}

void FEMixtureContact::ask_for_nonsymmetric_matrix() {
  if (parameters_.symmetric_stiffness) return;
  FEModel& model = *GetFEModel();
  for (int i = model.GetCurrentStepIndex(); i < model.Steps(); ++i) {
    auto* solver = dynamic_cast<FENewtonSolver*>(model.GetStep(i)->GetFESolver());
    if (solver == nullptr || solver->m_msymm != REAL_SYMMETRIC) continue;
    solver->m_msymm = REAL_UNSYMMETRIC;
    feLog(
        "sliding-mixture \"%s\": the matrix of step %d is set to non-symmetric, as that of this contact is. To keep it symmetric "
        "set <symmetric_stiffness>1</symmetric_stiffness> in the contact; convergence is slower then.\n",
        GetName().c_str(), i + 1);
  }
}

void FEMixtureContact::PrepStep() {
  if (!may_run_) throw FatalError();
  disputes_ = 0;
  line_search_.begin_step(newton_solver());
  at_step_start_ = true;
  ambient_.synchronise();
  if (!follow_load_curves()) throw FatalError();
  if (reads_properties_again(parameters_)) update_properties();
  if (core_->multiplier_layout().size() > 0) step_start_ = core_->unknown_multipliers();
  keep_matrix_if_it_fits();
}

// ------------------------------------------------------------ augmentation

bool FEMixtureContact::Augment(int augmentation, const FETimeInfo& /*time*/) {
  const TaskClock timed = core_->clock(Task::augmentation);
  // FEBio has converged with the status and gaps that were held: it is a solution only if the true laws agree.
  if (!core_->is_solution(fields()) || !clamped_.settled() || notices_overlap() ||
      line_search_.cut_short(newton_solver())) {
    // FEBio counts reformations anew after this: the limit on them is to hold all the same.
    const FENewtonSolver* newton = newton_solver();
    if (newton != nullptr && ++disputes_ > newton->m_maxref) throw MaxStiffnessReformations();
    keep_prediction_ = true;
    return false;
  }
  const Augmentation outcome = augment(GetName(), *core_, fields(), augmentation);
  for (const std::string& line : outcome.lines) feLog("%s\n", line.c_str());
  if (!outcome.warning.empty()) feLogWarning("%s", outcome.warning.c_str());
  return outcome.done;
}

bool FEMixtureContact::notices_overlap() {
  const UnnoticedOverlap noticed = core_->notice_overlap(fields());
  if (noticed.nodes == 0) return false;
  if (!std::exchange(said_noticed_, true)) {
    feLog("%s\n", noticed_line(GetName(), primary_.GetName(), secondary_.GetName(), noticed).c_str());
  }
  return !core_->is_solution(fields());
}

// ------------------------------------------------------------ output

void FEMixtureContact::store_output() {
  const TaskClock timed = core_->clock(Task::output);
  const PerSide<SurfaceFields> current = fields();
  Balance total = core_->balance(current);
  primary_.store_output(core_->nodal_output(Side::primary, current), total);
  total.force = -total.force;
  total.flow = -total.flow;
  secondary_.store_output(core_->nodal_output(Side::secondary, current), total);
}

void FEMixtureContact::warn_of_overlap() {
  if (warned_of_overlap_) return;
  const UnnoticedOverlap& overlap = core_->unnoticed_overlap();
  warned_of_overlap_ = overlap.nodes > 0;
  if (!warned_of_overlap_) return;
  feLogWarning("%s", overlap_warning(GetName(), primary_.GetName(), secondary_.GetName(), overlap).c_str());
}

bool FEMixtureContact::on_step_solved(FEModel* /*fem*/, unsigned int /*when*/, void* contact) {
  auto* self = static_cast<FEMixtureContact*>(contact);
  if (!self->IsActive()) return true;
  self->store_output();
  self->warn_of_overlap();
  self->clamped_.end_step();
  if (self->leads_extrapolation())
    self->extrapolation_.step_solved(self->GetFEModel()->GetCurrentStep()->GetFESolver()->m_niter);
  return true;
}

bool FEMixtureContact::on_solved(FEModel* fem, unsigned int /*when*/, void* contact) {
  const auto* self = static_cast<const FEMixtureContact*>(contact);
  const std::vector<std::string> table = price_table(self->GetName(), *self->core_, self->run_.peek());
  feLogEx(fem, "\n");
  for (const std::string& line : table) feLogEx(fem, "%s\n", line.c_str());
  return true;
}
