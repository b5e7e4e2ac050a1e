#include "tied_contact.h"

#include "archive.h"
#include "bound_contact.h"
#include "contact/tie/damage.h"
#include "contact/tie/joint_output.h"
#include "contact/tie/tie_output.h"
#include "host/augmentation.h"
#include "host/cohesive_zone.h"
#include "model_devices.h"
#include "offered_parameters.h"
#include "present_step.h"
#include "solver/febio/febio_system.h"
#include "surface_materials.h"
#include "tie_archive.h"

#include <FECore/FEAnalysis.h>
#include <FECore/FEException.h>
#include <FECore/FEModel.h>
#include <FECore/FENewtonSolver.h>

using namespace mixture_contact;

namespace {

/// Closes the initial gaps by relocation of the primary nodes. Returns false if there is nothing to tie.
bool close_gaps(const TieSetup& setup, ContactSurfaces& surfaces) {
  const std::unique_ptr<Tie> before = setup.build();
  if (before != nullptr) surfaces.relocate_primary(setup.relocated(*before));
  return before != nullptr;
}

/// True if all contacts of a model are ties, nothing else makes FEBio renew the matrix profile, and the device is on.
/// A tie that can break has a sliding contact.
bool has_constant_profile(FEModel& fem) {
  for (int i = 0; i < fem.SurfacePairConstraints(); ++i) {
    if (dynamic_cast<const FEMixtureTie*>(fem.SurfacePairConstraint(i)) == nullptr) return false;
  }
  return fem.NonlinearConstraints() == 0 && newton::has(chosen_devices(fem), newton::Device::constant_profile);
}

}  // namespace

BEGIN_FECORE_CLASS(FEMixtureTie, FEContactInterface)
  for_each_tie_parameter(parameters_,
                         [this](const ParameterTag& tag, auto& value) { offer_parameter(*this, tag, value); });
  BEGIN_PARAM_GROUP(heading(ParameterGroup::ambient));
  ADD_PARAMETER(parameters_.ambient.pressure, hosts_own::ambient_pressure.name)
      ->setUnits(unit_of(hosts_own::ambient_pressure.unit))
      ->setLongName(hosts_own::ambient_pressure.long_name)
      ->SetWatchVariable(&parameters_.has_ambient);
  END_PARAM_GROUP();
  ADD_PROPERTY(ambient_concentrations_, hosts_own::ambient_concentration.name, FEProperty::Optional)
      ->SetDefaultType("mixture_ambient_concentration")
      .SetLongName(hosts_own::ambient_concentration.long_name);
END_FECORE_CLASS()

FEMixtureTie::FEMixtureTie(FEModel* fem)
    : FEContactInterface(fem),
      log_(*this),
      surfaces_(*fem, *this),
      dofs_(surfaces_),
      setup_(dofs_, parameters_, log_),
      assembly_(dofs_) {
  // For any enforcement by the user, FEBio has to call Augment() before it accepts a solution.
  m_laugon = FECore::AUGLAG_METHOD;
  SetID(fem->SurfacePairConstraints() + 1);
}

// ------------------------------------------------------------ setting up

bool FEMixtureTie::Init() {
  dofs_.init();
  if (!ambient_concentrations_.empty()) parameters_.has_ambient = true;
  std::vector<std::string> wrong = find_load_curves(
      *this, [this](const auto& take) { for_each_tie_parameter(parameters_, take); });
  const std::string clash = devices_complaint(*GetFEModel(), parameters_.helpers.devices);
  if (!clash.empty()) wrong.push_back(clash);
  log_.errors(wrong);
  if (!wrong.empty() || !surfaces_.init(parameters_)) return false;
  if (!take_shell_bottoms(surfaces_, parameters_, log_) || !setup_.check()) return false;
  if (parameters_.gap.node_reloc && !close_gaps(setup_, surfaces_)) return false;
  if (parameters_.breaking.max_traction.given) add_sliding_contact();
  return true;
}

void FEMixtureTie::add_sliding_contact() {
  FEModel& fem = *GetFEModel();
  sliding_ = fecore_new<FESurfacePairConstraint>("sliding-mixture", &fem);
  sliding().act_for(*this);
  sliding().SetName(GetName() + " (broken)");
  for (const Side side : both_sides) {
    FESurface* const its = side == Side::primary ? sliding_->GetPrimarySurface() : sliding_->GetSecondarySurface();
    dynamic_cast<FEMixtureSurface&>(*its).take_facets_of(surfaces_[side]);
    its->SetName(surfaces_[side].GetName() + " (broken)");
  }
  if (!IsActive()) sliding().Deactivate();
  fem.AddSurfacePairConstraint(sliding_);  // FEBio initialises it after this tie
}

void FEMixtureTie::give_parameters(ContactParameters& parameters, AmbientConcentrations& ambient) {
  follow_tie(parameters, parameters_);
  while (ambient.size() < ambient_concentrations_.size())
    ambient.push_back(fecore_new<FEMixtureAmbientConcentration>("mixture_ambient_concentration", GetFEModel()));
  for (std::size_t n = 0; n < ambient.size(); ++n) {
    ambient[n]->solute = ambient_concentrations_[n]->solute;
    ambient[n]->value = ambient_concentrations_[n]->value;
  }
}

int FEMixtureTie::InitEquations(int first) {
  dofs_.number_multipliers(first);
  return tie_ == nullptr ? 0 : indexing::as_int(tie_->unknown_count());
}

void FEMixtureTie::Activate() {
  FEContactInterface::Activate();
  // A tie of a later step begins without stress at the positions of the bodies in that step. FEBio numbers equations
  // afterwards.
  if (tie_ == nullptr) tie_ = setup_.build();
  if (tie_ == nullptr) return;
  setup_.say_what_is_tied(*tie_);
  if (sliding_ == nullptr) return;
  setup_.judge_cohesive_zone(*tie_);
  join(sliding().bound().core(), joined_nodes(*tie_));
  if (!sliding_->IsActive()) sliding_->Activate();
}

void FEMixtureTie::Deactivate() {
  FEContactInterface::Deactivate();
  if (sliding_ != nullptr) sliding_->Deactivate();
}

PerSide<SurfaceFields> FEMixtureTie::fields() { return fields_of(dofs_, tie_->effects()); }

// ------------------------------------------------------------ steps and iterations

void FEMixtureTie::update_laws() {
  // FEBio catches exceptions in a step, but not in an activation.
  if (tie_ == nullptr || !setup_.update(*tie_)) log_.end_run();
}

void FEMixtureTie::PrepStep() {
  update_laws();
  step_start_ = tie_->unknowns();
  tractions_ = tie_->loads(fields()).traction;
  iterations_ = {};
}

void FEMixtureTie::Update() {
  // FEBio does not prepare contacts for a step, and calls for no augmentation, if its solver is not of Newton's kind.
  if (solver_kind_of(*GetFEModel()) == SolverKind::newton) return;
  update_laws();
  store_output(tie_->state().damage);
}

void FEMixtureTie::Update(const std::vector<double>& total, const std::vector<double>& increment) {
  const Index count = tie_ == nullptr ? 0 : tie_->unknown_count();
  if (count == 0) return;
  const auto own = [&](const std::vector<double>& all) {
    return Eigen::Map<const VectorXd>(all.data() + dofs_.first_multiplier(), count);
  };
  tie_->set_unknowns(step_start_ + own(total) + own(increment));
}

void FEMixtureTie::UpdateIncrements(std::vector<double>& total, const std::vector<double>& increment) {
  // FEBio's solver for solids does not update the values of equations that belong to no node.
  if (tie_ == nullptr) return;
  const int first = dofs_.first_multiplier();
  for (Index n = first; n < first + tie_->unknown_count(); ++n)
    mixture_contact::at(total, n) += mixture_contact::at(increment, n);
}

bool FEMixtureTie::Augment(int augmentation, const FETimeInfo& /*time*/) {
  store_output(tie_->state().damage);
  is_augmented_ = true;
  if (tie_->settings().enforcement == Enforcement::penalty) return true;
  const PerSide<SurfaceFields> now = fields();
  const Augmentation outcome = augment(log_.title(), tie_->gaps(now), tie_->settings(), tie_->effects(), augmentation,
                                       [&] { return tie_->augment(now); });
  for (const std::string& line : outcome.lines) log_.line(line);
  if (!outcome.warning.empty()) log_.warning(outcome.warning);
  is_augmented_ = outcome.done;
  return outcome.done;
}

bool FEMixtureTie::breaks_bonds(double left) {
  if (!std::holds_alternative<Brittle>(tie_->breaking())) return false;
  // An augmentation changes the loads. Only its last solution decides; without augmentations, each iteration does.
  const bool augments = tie_->settings().enforcement == Enforcement::augmented_lagrangian;
  const bool is_at_solution = left == 0;
  if (is_at_solution ? !is_augmented_ : augments) return false;
  const PerSide<SurfaceFields> now = fields();
  const Matrix3Xd change = tie_->loads(now).traction - tractions_;
  const Index before = broken_nodes(*tie_);
  take_damage(damage_after(*tie_, now, CurrentTime(), left * change.colwise().norm().maxCoeff()));
  tractions_ = tie_->loads(now).traction;  // without those of the nodes that break
  const Index broken = broken_nodes(*tie_) - before;
  if (broken > 0)
    log_.line(log_.title() + ": " + std::to_string(broken) + " nodes break, and the iterations continue.");
  return broken > 0;
}

void FEMixtureTie::step_solved() {
  DamageState damage = damage_after(*tie_, fields(), CurrentTime());
  store_output(damage);
  take_damage(std::move(damage));
}

void FEMixtureTie::step_failed() {
  if (is_softening()) log_.line_once(failed_softening_line(log_.title()));
}

void FEMixtureTie::take_damage(DamageState damage) {
  const Index before = broken_nodes(*tie_);
  mixture_contact::take_damage(*tie_, std::move(damage));
  if (broken_nodes(*tie_) != before) join(sliding().bound().core(), joined_nodes(*tie_));
}

void FEMixtureTie::store_output(const DamageState& damage) {
  InterfaceOutput out = output(*tie_, fields(), damage);
  if (sliding_ != nullptr) out = together(std::move(out), output(sliding().bound().core(), sliding().bound().fields()));
  surfaces_.store_output(out, tie_->effects());
}

// ------------------------------------------------------------ assembly and restarts

void FEMixtureTie::BuildMatrixProfile(FEGlobalMatrix& matrix) { assembly_.add_to_profile(*tie_, matrix); }

void FEMixtureTie::LoadVector(FEGlobalVector& residual, const FETimeInfo& time) {
  assembly_.residual(*tie_, residual, time.timeIncrement);
}

void FEMixtureTie::StiffnessMatrix(FELinearSystem& system, const FETimeInfo& time) {
  iterations_.begin(*tie_, fields());
  auto* const solver = dynamic_cast<FENewtonSolver*>(GetFEModel()->GetCurrentStep()->GetFESolver());
  assembly_.tangent(*tie_, system, *solver->GetStiffnessMatrix(), time.timeIncrement, iterations_.softening());
  if (!has_constant_profile(*GetFEModel())) return;
  newton::FEBioSolver present(*GetFEModel());
  newton::FEBioSystem(present).keep_profile();
  log_.line_once(log_.title() + ": solver device constant_profile: FEBio makes the matrix profile once.");
}

void FEMixtureTie::serialize_model(DumpStream& ar) {
  for (const Side side : both_sides) surfaces_[side].Serialize(ar);
  dofs_.serialize(ar);
  for_each_tie_parameter(parameters_, [&ar](const ParameterTag& tag, auto& /*value*/) {
    for (bool* const flag : {tag.given, tag.varies}) {
      if (flag != nullptr) ar&* flag;
    }
  });
  archive(ar, step_start_);
  bool has_sliding_contact = sliding_ != nullptr;
  ar & has_sliding_contact;
  if (has_sliding_contact) ar & sliding_;
  bool is_built = tie_ != nullptr;
  ar & is_built;
  if (!is_built) return;
  archive_tie(ar, tie_, setup_.breaking());
  // After reading, FEBio reads its steps and solvers; PrepStep() then sets the laws for them.
  if (!ar.IsSaving()) tie_->set_laws(tie_settings(parameters_, SolverKind::newton, 0, tie_->breaking()));
}

void FEMixtureTie::Serialize(DumpStream& ar) {
  FEContactInterface::Serialize(ar);
  if (!ar.IsShallow()) serialize_model(ar);
  if (tie_ == nullptr) return;
  TieState state = tie_->state();
  archive_state(ar, state);
  if (ar.IsSaving()) return;
  tie_->restore(std::move(state));
  if (sliding_ == nullptr) return;
  sliding().act_for(*this);
  join(sliding().bound().core(), joined_nodes(*tie_));
}
