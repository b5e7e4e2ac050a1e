#include "mixture_contact.h"

#include "archive.h"
#include "contact/base/indexed_vector.h"
#include "contact/interface/multipliers.h"
#include "contact/interface/relocation.h"
#include "host/augmentation.h"
#include "host/linear_solvers.h"
#include "host/parameter_groups.h"

#include <FECore/Callback.h>
#include <FECore/FEAnalysis.h>
#include <FECore/FECoreKernel.h>
#include <FECore/FEException.h>
#include <FECore/FELinearConstraintManager.h>
#include <FECore/FEModel.h>
#include <FECore/FENewtonSolver.h>
#include <FECore/FESolver.h>
#include <FECore/LinearSolver.h>

#include <utility>

using namespace mixture_contact;

namespace {

const char* unit_of(Unit unit) {
  switch (unit) {
    case Unit::length:
      return UNIT_LENGTH;
    case Unit::pressure:
      return UNIT_PRESSURE;
    case Unit::concentration:
      return UNIT_CONCENTRATION;
    case Unit::none:
      break;
  }
  return UNIT_NONE;
}

/// Opens the group that the parameter belongs to; what has none is hidden.
template <class Add>
FEParam* in_its_group(FEParamContainer& owner, const char* name, const Add& add) {
  const char* const heading = parameter_group(name);
  owner.BeginParameterGroup(heading);
  FEParam* const parameter = add();
  owner.EndParameterGroup();
  if (heading == nullptr) parameter->SetFlags(parameter->GetFlags() | FE_PARAM_HIDDEN);
  return parameter;
}

}  // namespace

BEGIN_FECORE_CLASS(FEMixtureContact, FEContactInterface)
  for_each_parameter(parameters_, [this](const ParameterTag& tag, auto& value) {
    FEParam* parameter = in_its_group(*this, tag.name, [&] { return AddParameter(value, tag.name); });
    parameter->setLongName(tag.long_name)->setUnits(unit_of(tag.unit));
    parameter->SetWatchVariable(tag.given);
    if (tag.choices != nullptr) parameter->setEnums(tag.choices);
  });
  BEGIN_PARAM_GROUP(parameter_group("ambient_pressure"));
  ADD_PARAMETER(parameters_.ambient_pressure, "ambient_pressure")
      ->setUnits(UNIT_PRESSURE)
      ->setLongName("ambient pressure");
  END_PARAM_GROUP();
  ADD_PROPERTY(ambient_concentrations_, "ambient_concentration", FEProperty::Optional)
      ->SetDefaultType("mixture_ambient_concentration")
      .SetLongName("ambient concentration");
END_FECORE_CLASS()

FEMixtureContact::FEMixtureContact(FEModel* fem)
    : FEContactInterface(fem),
      model_(ModelContacts::of(*fem)),
      log_(*this),
      surfaces_(*fem, *this),
      dofs_(*fem, surfaces_),
      bound_(surfaces_, dofs_, parameters_, log_),
      setup_(*fem, surfaces_, dofs_, parameters_, ambient_concentrations_, log_),
      assembly_(bound_, dofs_),
      output_(bound_, surfaces_, log_) {
  // Whatever the user's enforcement, FEBio is to ask Augment() before it accepts a solution.
  m_laugon = FECore::AUGLAG_METHOD;
  SetID(fem->SurfacePairConstraints() + 1);
  model_->add(*this);
}

FEMixtureContact::~FEMixtureContact() { model_->remove(*this); }

// ------------------------------------------------------------ setting up

bool FEMixtureContact::Init() {
  dofs_.init();
  find_load_curves();
  find_self_contact();
  const std::vector<std::string> wrong = model_->complaints(*this);
  log_.errors(wrong);
  if (!setup_.check_parameters() || !wrong.empty()) return false;
  if (m_psf != 1 || m_psfmax != 0)
    log_.say("<penalty_sf> and <max_penalty_sf> have no effect: penalties grow by themselves.");
  for (const Side side : both_sides) {
    if (!surfaces_[side].Init()) return false;
  }
  if (parameters_.flip_primary) surfaces_[Side::primary].turn_round();
  if (parameters_.flip_secondary) surfaces_[Side::secondary].turn_round();
  return setup_.check_surfaces() && take_shell_bottoms() && setup_.build(bound_) && setup_.check_ambient();
}

bool FEMixtureContact::take_shell_bottoms() {
  const PerSide<bool> bottoms{{parameters_.shell_bottom_primary, parameters_.shell_bottom_secondary}};
  for (const Side side : both_sides) {
    if (!bottoms[side]) continue;
    if (!setup_.are_shells(side)) return false;
    surfaces_[side].take_shell_bottoms();
  }
  return true;
}

void FEMixtureContact::find_self_contact() {
  const int common = surfaces_.common_facets();
  parameters_.self_contact = common > 0;
  const bool is_same = common == surfaces_[Side::primary].Elements() && common == surfaces_[Side::secondary].Elements();
  if (is_same && std::exchange(parameters_.two_pass, false))
    log_.say("<two_pass> has no effect: both surfaces are the same, so that each side has conditions already.");
}

void FEMixtureContact::find_load_curves() {
  const auto varies = [this](double& value) {
    return GetFEModel()->GetLoadController(FindParameterFromData(&value)) != nullptr;
  };
  parameters_.penalty_varies = varies(parameters_.penalty);
  parameters_.pressure_penalty_varies = varies(parameters_.pressure_penalty);
  parameters_.concentration_penalty_varies = varies(parameters_.concentration_penalty);
  parameters_.fric_coeff_varies = varies(parameters_.fric_coeff);
}

int FEMixtureContact::InitEquations(int first) {
  may_run_ = setup_.decide_traction(bound_);
  dofs_.number_multipliers(first);
  return newton::as_int(multiplier_layout(core()).size());
}

void FEMixtureContact::Activate() {
  FEContactInterface::Activate();
  if (parameters_.node_reloc && !relocated_) {
    surfaces_.relocate_primary(without_overlap(core(), surfaces_.positions()));
    relocated_ = true;
  }
  setup_.update_laws(bound_, model_->penalty_reduction());
  setup_.update_properties(bound_);
  ask_for_nonsymmetric_matrix();
  judge_linear_solver();
  model_->activate(*this);
}

void FEMixtureContact::Deactivate() {
  FEContactInterface::Deactivate();
  if (bound_.is_built()) core().forget_friction();  // FEBio deactivates what belongs to a step as it reads it
  model_->deactivate(*this);
}

void FEMixtureContact::ask_for_nonsymmetric_matrix() {
  if (parameters_.symmetric_stiffness) return;
  FEModel& model = *GetFEModel();
  for (int i = model.GetCurrentStepIndex(); i < model.Steps(); ++i) {
    auto* solver = dynamic_cast<FENewtonSolver*>(model.GetStep(i)->GetFESolver());
    if (solver == nullptr || solver->m_msymm != REAL_SYMMETRIC) continue;
    solver->m_msymm = REAL_UNSYMMETRIC;
    log_.say("the matrix of step " + std::to_string(i + 1) +
             " is set to non-symmetric, as that of this contact is. To keep it symmetric set "
             "<symmetric_stiffness>1</symmetric_stiffness> in the contact; convergence is slower then.");
  }
}

void FEMixtureContact::judge_linear_solver() const {
  FEModel& model = *GetFEModel();
  for (int i = model.GetCurrentStepIndex(); i < model.Steps(); ++i) {
    auto* solver = dynamic_cast<FENewtonSolver*>(model.GetStep(i)->GetFESolver());
    if (solver == nullptr) continue;
    LinearSolver* const chosen = solver->GetLinearSolver();
    const std::string type = chosen == nullptr ? FECoreKernel::GetInstance().GetLinearSolverType()
                                               : chosen->GetTypeStr();
    const MatrixKind matrix{solver->m_msymm == REAL_SYMMETRIC, core().pass(0).has_unknown_multipliers()};
    const std::string complaint = linear_solver_complaint(type, matrix);
    if (!complaint.empty()) return log_.say(complaint);
  }
}

// ------------------------------------------------------------ steps and iterations

void FEMixtureContact::PrepStep() {
  if (!may_run_ || !setup_.follow_load_curves(bound_, model_->penalty_reduction())) throw FatalError();
  if (reads_properties_again(parameters_)) setup_.update_properties(bound_);
  model_->prepare_step(*this);
}

void FEMixtureContact::Update() {
  // FEBio prepares no steps for contacts where its solver is none of Newton's kind.
  if (!model_->solver().is_newton() && !setup_.follow_load_curves(bound_, model_->penalty_reduction()))
    throw FatalError();
  model_->steps().evaluate(this);
}

void FEMixtureContact::Update(const std::vector<double>& total, const std::vector<double>& increment) {
  bound_.set_multipliers(total, increment);
  model_->steps().try_increment(this, increment);
}

void FEMixtureContact::UpdateIncrements(std::vector<double>& total, const std::vector<double>& increment) {
  // FEBio's solver for solids leaves equations that are not nodes' to their owners.
  const int first = dofs_.first_multiplier();
  for (Index n = first; n < first + multiplier_layout(core()).size(); ++n)
    mixture_contact::at(total, n) += mixture_contact::at(increment, n);
}

bool FEMixtureContact::Augment(int augmentation, const FETimeInfo& /*time*/) {
  const TaskClock timed = core().measurements().clock(Task::augmentation);
  if (!model_->steps().accepts(this)) return false;
  const Augmentation outcome = augment(GetName(), core(), bound_.fields(), augmentation);
  for (const std::string& line : outcome.lines) log_.line(line);
  if (!outcome.warning.empty()) log_.warning(outcome.warning);
  return outcome.done;
}

void FEMixtureContact::on_callback(unsigned int when) {
  if (when == CB_TIMESTEP_SOLVED) {
    output_.store();
    core().accept_step(bound_.fields());
  }
  if (when == CB_SOLVED) output_.log_timings();
}

// ------------------------------------------------------------ assembly

void FEMixtureContact::BuildMatrixProfile(FEGlobalMatrix& matrix) {
  model_->steps().before_matrix();
  assembly_.add_to_profile(matrix);
}

void FEMixtureContact::LoadVector(FEGlobalVector& residual, const FETimeInfo& time) {
  assembly_.residual(residual, time.timeIncrement);
}

void FEMixtureContact::StiffnessMatrix(FELinearSystem& system, const FETimeInfo& time) {
  const bool is_constrained = GetFEModel()->GetLinearConstraintManager().LinearConstraints() > 0;
  assembly_.tangent(system, *model_->solver().febio()->GetStiffnessMatrix(), is_constrained, time.timeIncrement);
}

// ------------------------------------------------------------ ambient values and restarts

double FEMixtureContact::ambient_value(int dof) const {
  if (dof == dofs_.pressure(false) || dof == dofs_.pressure(true)) return parameters_.ambient_pressure;
  for (const FEMixtureAmbientConcentration* ambient : ambient_concentrations_) {
    const int solute = ambient->solute > 0 ? ambient->solute - 1 : 0;
    if (dof == dofs_.concentration(false, solute) || dof == dofs_.concentration(true, solute)) return ambient->value;
  }
  return 0;
}

void FEMixtureContact::Serialize(DumpStream& ar) {
  FEContactInterface::Serialize(ar);
  for (const Side side : both_sides) surfaces_[side].Serialize(ar);
  if (!ar.IsShallow()) {
    ar & relocated_;
    dofs_.serialize(ar);
    for_each_parameter(parameters_, [&ar](const ParameterTag& tag, auto& /*value*/) {
      if (tag.given == nullptr) return;
      bool& given = *tag.given;
      ar & given;
    });
    ar & parameters_.self_contact & parameters_.penalty_varies & parameters_.pressure_penalty_varies &
        parameters_.concentration_penalty_varies & parameters_.fric_coeff_varies;
  }
  bound_.serialize(ar);
  model_->serialize(*this, ar);
}
