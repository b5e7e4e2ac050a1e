#include "mixture_contact.h"

#include "archive.h"
#include "contact/base/indexed_vector.h"
#include "contact/interface/multipliers.h"
#include "contact/interface/relocation.h"
#include "host/augmentation.h"
#include "linear_constraints.h"
#include "matrix_requests.h"
#include "offered_parameters.h"
#include "surface_materials.h"

#include <FECore/Callback.h>
#include <FECore/FEAnalysis.h>
#include <FECore/FEException.h>
#include <FECore/FEMesh.h>
#include <FECore/FEModel.h>
#include <FECore/FENewtonSolver.h>
#include <FECore/FESolver.h>

#include <utility>

using namespace mixture_contact;

BEGIN_FECORE_CLASS(FEMixtureContact, FEContactInterface)
  for_each_parameter(parameters_, [this](const ParameterTag& tag, auto& value) { offer_parameter(*this, tag, value); });
  BEGIN_PARAM_GROUP(heading(ParameterGroup::ambient));
  ADD_PARAMETER(parameters_.ambient.pressure, hosts_own::ambient_pressure.name)
      ->setUnits(unit_of(hosts_own::ambient_pressure.unit))
      ->setLongName(hosts_own::ambient_pressure.long_name);
  END_PARAM_GROUP();
  ADD_PROPERTY(properties_.ambient, hosts_own::ambient_concentration.name, FEProperty::Optional)
      ->SetDefaultType("mixture_ambient_concentration")
      .SetLongName(hosts_own::ambient_concentration.long_name);
  ADD_PROPERTY(properties_.membrane.permeances, hosts_own::solute_permeance.name, FEProperty::Optional)
      ->SetDefaultType("mixture_solute_permeance")
      .SetLongName(hosts_own::solute_permeance.long_name);
  ADD_PROPERTY(properties_.membrane.reflections, hosts_own::reflection.name, FEProperty::Optional)
      ->SetDefaultType("mixture_reflection")
      .SetLongName(hosts_own::reflection.long_name);
END_FECORE_CLASS()

FEMixtureContact::FEMixtureContact(FEModel* fem)
    : FEContactInterface(fem),
      model_(ModelContacts::of(*fem)),
      surfaces_(*fem, *this),
      bound_(surfaces_, parameters_, *this),
      setup_(bound_),
      assembly_(bound_, loads_) {
  // For any enforcement by the user, FEBio has to call Augment() before it accepts a solution.
  m_laugon = FECore::AUGLAG_METHOD;
  SetID(fem->SurfacePairConstraints() + 1);
  model_->add(*this);
}

FEMixtureContact::~FEMixtureContact() { model_->remove(*this); }

// ------------------------------------------------------------ setting up

bool FEMixtureContact::Init() {
  bound_.dofs().init();
  std::vector<std::string> wrong = find_load_curves(
      *this, [this](const auto& take) { for_each_parameter(parameters_, take); });
  parameters_.membrane.thermal_energy = GetFEModel()->GetGlobalConstant("R") * GetFEModel()->GetGlobalConstant("T");
  read_properties();
  find_self_contact();
  for (const std::string& complaint : model_->complaints(*this)) wrong.push_back(complaint);
  bound_.log().errors(wrong);
  if (!setup_.check_parameters(properties_.ambient) || !wrong.empty()) return false;
  if (m_psf != 1 || m_psfmax != 0)
    bound_.log().say("<penalty_sf> and <max_penalty_sf> have no effect: AUGLAG raises penalties automatically.");
  if (!surfaces_.init(parameters_)) return false;
  const bool sound = setup_.check_surfaces() && take_shell_bottoms(surfaces_, parameters_, bound_.log()) &&
                     setup_.check_mesh_adaptors() && setup_.build() && setup_.check_ambient(properties_.ambient);
  surfaces_.take_change();
  return sound;
}

void FEMixtureContact::read_properties() {
  if (bound_.owner() != nullptr) bound_.owner()->give_parameters(parameters_, properties_.ambient);
  read_membrane(properties_.membrane, parameters_.membrane);
}

void FEMixtureContact::find_self_contact() {
  const int common = surfaces_.common_facets();
  parameters_.self_contact = common > 0;
  const bool is_same = common == surfaces_[Side::primary].Elements() && common == surfaces_[Side::secondary].Elements();
  if (is_same && std::exchange(parameters_.enforcement.two_pass, false))
    bound_.log().say("<two_pass> has no effect: both surfaces are the same, and each side has conditions already.");
}

int FEMixtureContact::InitEquations(int first) {
  may_run_ = setup_.decide_traction();
  setup_.find_immovable_nodes();
  assembly_.forget_matrix();
  bound_.dofs().number_multipliers(first);
  const int multipliers = indexing::as_int(multiplier_layout(core()).size());
  return multipliers + loads_.number(first + multipliers, core(), surfaces_with_load_equations());
}

PerSide<bool> FEMixtureContact::surfaces_with_load_equations() const {
  // Loads are no unknowns in two cases. FEBio repeats a failed step with the same unknowns, but elements may have
  // eroded in it; and a matrix with linear constraints accepts only whole blocks.
  const bool has_other_unknowns = GetFEModel()->MeshAdaptors() > 0 || has_linear_constraints(*GetFEModel());
  const bool any = bound_.owner() == nullptr && model_->devices().is_on(newton::Device::loads_as_unknowns) &&
                   core().pass(0).has_load_blocks() && takes_mixed_form(*GetFEModel()) && !has_other_unknowns &&
                   model_->steps().allow_further_unknowns() && bound_.dofs().has_free_node(Side::primary) &&
                   bound_.dofs().has_free_node(Side::secondary);
  return {{any, any && core().settings().two_pass}};
}

void FEMixtureContact::follow_surfaces() {
  const NumberedState before = bound_.numbered_state();
  const bool is_same_mesh = bound_.nodes_of_mesh() == GetFEModel()->GetMesh().Nodes();
  if (!setup_.check_surfaces() || !setup_.build()) bound_.log().end_run();
  if (is_same_mesh) bound_.go_on_from(before);
  bound_.log().line("sliding-mixture \"" + GetName() + "\": the facets of its surfaces have changed, " +
                    std::to_string(surfaces_[Side::primary].Elements()) + " and " +
                    std::to_string(surfaces_[Side::secondary].Elements()) + " now.");
}

void FEMixtureContact::Activate() {
  FEContactInterface::Activate();
  read_properties();
  const bool has_changed = surfaces_.take_change();
  if (const FEMixtureSurface* const gone = surfaces_.without_facets()) {
    bound_.log().say("surface \"" + gone->GetName() + "\" has no facets left, and the contact is switched off.");
    return Deactivate();
  }
  if (parameters_.gap.node_reloc && !relocated_) {
    surfaces_.relocate_primary(without_overlap(core(), surfaces_.positions()));
    relocated_ = true;
  }
  if (has_changed) follow_surfaces();
  setup_.update_laws(model_->penalty_reduction());
  setup_.update_properties();
  if (!parameters_.enforcement.symmetric_stiffness) ask_for_nonsymmetric_matrix(*GetFEModel(), bound_.log());
  judge_linear_solver(*GetFEModel(), core().pass(0).space().has_unknown_multipliers(), bound_.log());
  model_->activate(*this);
  if (has_changed) output_.store(bound_);
}

void FEMixtureContact::Deactivate() {
  FEContactInterface::Deactivate();
  if (bound_.is_built()) core().forget_steps();  // FEBio deactivates the contacts of a step when it reads the step
  model_->steps().reset_rounds();                // the set of active contacts has changed
}

// ------------------------------------------------------------ steps and iterations

void FEMixtureContact::PrepStep() {
  read_properties();
  setup_.find_immovable_nodes();  // the surfaces may have changed since FEBio numbered the equations
  if (!may_run_ || !setup_.follow_load_curves(properties_.ambient, model_->penalty_reduction())) bound_.log().end_run();
  if (reads_properties_again(parameters_, core().effects())) setup_.update_properties();
  model_->prepare_step(*this);
}

void FEMixtureContact::Update() {
  read_properties();
  // FEBio does not prepare contacts for a step if its solver is not of Newton's kind.
  if (!model_->solver().is_newton() && !setup_.follow_load_curves(properties_.ambient, model_->penalty_reduction()))
    bound_.log().end_run();
  model_->steps().evaluate(&bound_);
}

void FEMixtureContact::Update(const std::vector<double>& total, const std::vector<double>& increment) {
  bound_.set_multipliers(total, increment);
  model_->steps().try_increment(&bound_, increment);
}

void FEMixtureContact::UpdateIncrements(std::vector<double>& total, const std::vector<double>& increment) {
  // FEBio's solver for solids does not update the values of equations that belong to no node.
  const int first = bound_.dofs().first_multiplier();
  for (Index n = first; n < first + multiplier_layout(core()).size(); ++n)
    mixture_contact::at(total, n) += mixture_contact::at(increment, n);
}

bool FEMixtureContact::Augment(int augmentation, const FETimeInfo& /*time*/) {
  const TaskClock timed = core().measurements().clock(Task::augmentation);
  if (!model_->steps().accepts(&bound_)) return false;
  const Augmentation outcome = augment(GetName(), core(), bound_.fields(), augmentation);
  if (outcome.stiffens) model_->force_new_matrix();
  for (const std::string& line : outcome.lines) bound_.log().line(line);
  if (!outcome.warning.empty()) bound_.log().warning(outcome.warning);
  if (!outcome.done || !bound_.breaks_bonds(0)) return outcome.done;
  model_->force_new_matrix();
  return false;
}

void FEMixtureContact::on_callback(unsigned int when) {
  if (when == CB_TIMESTEP_SOLVED) {
    output_.store(bound_);
    core().accept_step(bound_.fields());
    if (bound_.owner() != nullptr) bound_.owner()->step_solved();
  }
  if (when == CB_TIMESTEP_FAILED) {
    const std::string advice = bound_.fail_step();
    if (bound_.owner() != nullptr) {
      bound_.owner()->step_failed();
    } else if (!advice.empty()) {
      bound_.log().line(advice);
    }
  }
  if (when == CB_SOLVED) output_.log_timings(bound_);
}

// ------------------------------------------------------------ assembly

void FEMixtureContact::BuildMatrixProfile(FEGlobalMatrix& matrix) {
  model_->steps().before_matrix();
  assembly_.add_to_profile(matrix, model_->matrix_form());
}

void FEMixtureContact::LoadVector(FEGlobalVector& residual, const FETimeInfo& time) {
  assembly_.residual(residual, time.timeIncrement);
}

void FEMixtureContact::StiffnessMatrix(FELinearSystem& system, const FETimeInfo& time) {
  assembly_.tangent(system, *model_->solver().febio()->GetStiffnessMatrix(), time.timeIncrement);
  model_->added_tangent(*this);
}

// ------------------------------------------------------------ ambient values and restarts

double FEMixtureContact::ambient_value(int dof) const {
  if (dof == bound_.dofs().pressure(false) || dof == bound_.dofs().pressure(true)) return parameters_.ambient.pressure;
  for (const FEMixtureAmbientConcentration* ambient : properties_.ambient) {
    const int solute = ambient->solute > 0 ? ambient->solute - 1 : 0;
    if (dof == bound_.dofs().concentration(false, solute) || dof == bound_.dofs().concentration(true, solute))
      return ambient->value;
  }
  return 0;
}

void FEMixtureContact::Serialize(DumpStream& ar) {
  FEContactInterface::Serialize(ar);
  for (const Side side : both_sides) surfaces_[side].Serialize(ar);
  if (!ar.IsShallow()) {
    ar & relocated_;
    bound_.dofs().serialize(ar);
    loads_.serialize(ar);
    for_each_parameter(parameters_, [&ar](const ParameterTag& tag, auto& /*value*/) {
      for (bool* const flag : {tag.given, tag.varies}) {
        if (flag != nullptr) ar&* flag;
      }
    });
    ar & parameters_.self_contact & parameters_.membrane.thermal_energy;
    read_properties();
  }
  bound_.serialize(ar);
  model_->serialize(*this, ar);
}
