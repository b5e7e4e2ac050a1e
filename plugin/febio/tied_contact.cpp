#include "tied_contact.h"

#include "archive.h"
#include "bound_contact.h"
#include "contact/tie/tie_output.h"
#include "contact_setup.h"
#include "host/augmentation.h"
#include "offered_parameters.h"
#include "surface_materials.h"
#include "tie_archive.h"

#include <FECore/FEAnalysis.h>
#include <FECore/FEException.h>
#include <FECore/FEModel.h>
#include <FECore/FENewtonSolver.h>

using namespace mixture_contact;

BEGIN_FECORE_CLASS(FEMixtureTie, FEContactInterface)
  for_each_tie_parameter(parameters_,
                         [this](const ParameterTag& tag, auto& value) { offer_parameter(*this, tag, value); });
END_FECORE_CLASS()

FEMixtureTie::FEMixtureTie(FEModel* fem)
    : FEContactInterface(fem),
      log_(*this),
      surfaces_(*fem, *this),
      dofs_(*fem, surfaces_),
      setup_(*fem, surfaces_, dofs_, parameters_, log_),
      assembly_(surfaces_, dofs_) {
  // Whatever the user's enforcement, FEBio is to ask Augment() before it accepts a solution.
  m_laugon = FECore::AUGLAG_METHOD;
  SetID(fem->SurfacePairConstraints() + 1);
}

// ------------------------------------------------------------ setting up

bool FEMixtureTie::Init() {
  dofs_.init();
  const std::vector<std::string> wrong = find_load_curves(
      *this, [this](const auto& take) { for_each_tie_parameter(parameters_, take); });
  log_.errors(wrong);
  if (!wrong.empty() || !prepare_surfaces() || !setup_.check()) return false;
  return !parameters_.gap.node_reloc || close_gaps();
}

bool FEMixtureTie::prepare_surfaces() {
  for (const Side side : both_sides) {
    if (!surfaces_[side].Init()) return false;
    if (parameters_.surfaces[side].flip) surfaces_[side].turn_round();
  }
  return take_shell_bottoms(surfaces_, parameters_, log_);
}

bool FEMixtureTie::close_gaps() {
  const std::unique_ptr<Tie> before = setup_.build();
  if (before != nullptr) surfaces_.relocate_primary(setup_.relocated(*before));
  return before != nullptr;
}

int FEMixtureTie::InitEquations(int first) {
  dofs_.number_multipliers(first);
  return tie_ == nullptr ? 0 : indexing::as_int(tie_->unknown_count());
}

void FEMixtureTie::Activate() {
  FEContactInterface::Activate();
  // A tie of a later step begins without stress where bodies are by then. FEBio counts equations after this.
  if (tie_ == nullptr) tie_ = setup_.build();
  if (tie_ != nullptr) setup_.say_what_is_tied(*tie_);
}

PerSide<SurfaceFields> FEMixtureTie::fields() { return fields_of(surfaces_, dofs_, tie_->effects()); }

// ------------------------------------------------------------ steps and iterations

void FEMixtureTie::update_laws() {
  // FEBio catches what a step throws, and nothing that an activation does.
  if (tie_ == nullptr || !setup_.update(*tie_)) log_.end_run();
}

void FEMixtureTie::PrepStep() {
  update_laws();
  step_start_ = tie_->unknowns();
}

void FEMixtureTie::Update() {
  // FEBio prepares no steps for contacts, and asks for no augmentation, where its solver is none of Newton's kind.
  if (solver_kind_of(*GetFEModel()) == SolverKind::newton) return;
  update_laws();
  store_output();
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
  // FEBio's solver for solids leaves equations that are not nodes' to their owners.
  if (tie_ == nullptr) return;
  const int first = dofs_.first_multiplier();
  for (Index n = first; n < first + tie_->unknown_count(); ++n)
    mixture_contact::at(total, n) += mixture_contact::at(increment, n);
}

bool FEMixtureTie::Augment(int augmentation, const FETimeInfo& /*time*/) {
  store_output();
  if (tie_->settings().enforcement == Enforcement::penalty) return true;
  const PerSide<SurfaceFields> now = fields();
  const Augmentation outcome = augment(log_.title(), tie_->gaps(now), tie_->settings(), tie_->effects(), augmentation,
                                       [&] { return tie_->augment(now); });
  for (const std::string& line : outcome.lines) log_.line(line);
  if (!outcome.warning.empty()) log_.warning(outcome.warning);
  return outcome.done;
}

void FEMixtureTie::store_output() {
  const InterfaceOutput out = output(*tie_, fields());
  const std::vector<int> exchanged = exchanged_solutes(tie_->effects());
  Balance total = out.balance;
  surfaces_[Side::primary].store_output(out.nodes[Side::primary], total, exchanged);
  total.force = -total.force;
  total.flow = -total.flow;
  surfaces_[Side::secondary].store_output(out.nodes[Side::secondary], total, exchanged);
}

// ------------------------------------------------------------ assembly and restarts

void FEMixtureTie::BuildMatrixProfile(FEGlobalMatrix& matrix) { assembly_.add_to_profile(*tie_, matrix); }

void FEMixtureTie::LoadVector(FEGlobalVector& residual, const FETimeInfo& time) {
  assembly_.residual(*tie_, residual, time.timeIncrement);
}

void FEMixtureTie::StiffnessMatrix(FELinearSystem& system, const FETimeInfo& time) {
  auto* const solver = dynamic_cast<FENewtonSolver*>(GetFEModel()->GetCurrentStep()->GetFESolver());
  assembly_.tangent(*tie_, system, *solver->GetStiffnessMatrix(), time.timeIncrement);
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
  bool is_built = tie_ != nullptr;
  ar & is_built;
  if (!is_built) return;
  archive_tie(ar, tie_);
  // FEBio reads its steps and solvers later; PrepStep() follows those.
  if (!ar.IsSaving()) tie_->set_laws(tie_settings(parameters_, SolverKind::newton, 0));
}

void FEMixtureTie::Serialize(DumpStream& ar) {
  FEContactInterface::Serialize(ar);
  if (!ar.IsShallow()) serialize_model(ar);
  if (tie_ == nullptr) return;
  TieState state = tie_->state();
  archive_state(ar, state);
  if (!ar.IsSaving()) tie_->restore(std::move(state));
}
