#include "mixture_contact.h"

#include "archive.h"
#include "host/price.h"
#include "material_properties.h"

#include <FEBioMech/FEMechModel.h>
#include <FECore/DumpStream.h>
#include <FECore/FEAnalysis.h>
#include <FECore/FEException.h>
#include <FECore/FEGlobalMatrix.h>
#include <FECore/FEGlobalVector.h>
#include <FECore/FELinearSystem.h>
#include <FECore/FEMesh.h>
#include <FECore/FEModel.h>
#include <FECore/FESolidDomain.h>
#include <FECore/FESolver.h>
#include <FECore/log.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

using namespace mixture_contact;

BEGIN_FECORE_CLASS(FEMixtureContact, FEContactInterface)
  ADD_PARAMETER(parameters_.effects, "effects");
  ADD_PARAMETER(parameters_.laugon, "laugon")
      ->setLongName("Enforcement method")
      ->setEnums("PENALTY\0AUGLAG\0LAGMULT\0");
  ADD_PARAMETER(parameters_.tolerance, "tolerance");
  ADD_PARAMETER(parameters_.traction_tolerance, "traction_tolerance", parameters_.traction_tolerance_given);
  ADD_PARAMETER(parameters_.solvent_tolerance, "solvent_tolerance", parameters_.solvent_tolerance_given);
  ADD_PARAMETER(parameters_.solute_tolerance, "solute_tolerance", parameters_.solute_tolerance_given);
  ADD_PARAMETER(parameters_.gaptol, "gaptol")->setUnits(UNIT_LENGTH);
  ADD_PARAMETER(parameters_.ptol, "ptol")->setUnits(UNIT_PRESSURE);
  ADD_PARAMETER(parameters_.ctol, "ctol")->setUnits(UNIT_CONCENTRATION);
  ADD_PARAMETER(parameters_.penalty, "penalty", parameters_.penalty_given);
  ADD_PARAMETER(parameters_.pressure_penalty, "pressure_penalty", parameters_.pressure_penalty_given);
  ADD_PARAMETER(parameters_.concentration_penalty, "concentration_penalty", parameters_.concentration_penalty_given);
  ADD_PARAMETER(parameters_.auto_penalty, "auto_penalty");
  ADD_PARAMETER(parameters_.update_penalty, "update_penalty");
  ADD_PARAMETER(parameters_.two_pass, "two_pass");
  ADD_PARAMETER(parameters_.symmetric_stiffness, "symmetric_stiffness");
  ADD_PARAMETER(parameters_.integration, "integration")->setEnums("gauss\0segments\0");
  ADD_PARAMETER(parameters_.integration_order, "integration_order");
  ADD_PARAMETER(parameters_.search_tol, "search_tol");
  ADD_PARAMETER(parameters_.search_radius, "search_radius", parameters_.search_radius_given)->setUnits(UNIT_LENGTH);
  ADD_PARAMETER(parameters_.seg_up, "seg_up");
  ADD_PARAMETER(parameters_.extrapolation, "extrapolation");
  ADD_PARAMETER(parameters_.node_reloc, "node_reloc");
  ADD_PARAMETER(parameters_.minaug, "minaug");
  ADD_PARAMETER(parameters_.maxaug, "maxaug");
  ADD_PARAMETER(parameters_.ambient_pressure, "ambient_pressure")->setUnits(UNIT_PRESSURE);
  ADD_PARAMETER(parameters_.flip_primary, "flip_primary");
  ADD_PARAMETER(parameters_.flip_secondary, "flip_secondary");
  ADD_PARAMETER(parameters_.fric_coeff, "fric_coeff");
  ADD_PARAMETER(parameters_.contact_frac, "contact_frac", parameters_.contact_frac_given);
  ADD_PARAMETER(parameters_.offset, "offset");
  ADD_PARAMETER(parameters_.tension, "tension");
  ADD_PARAMETER(parameters_.shell_bottom_primary, "shell_bottom_primary");
  ADD_PARAMETER(parameters_.shell_bottom_secondary, "shell_bottom_secondary");
  ADD_PARAMETER(parameters_.knmult, "knmult")->SetWatchVariable(&parameters_.knmult_given);
  ADD_PARAMETER(parameters_.smooth_aug, "smooth_aug")->SetWatchVariable(&parameters_.smooth_aug_given);
  ADD_PARAMETER(parameters_.smooth_fls, "smooth_fls")->SetWatchVariable(&parameters_.smooth_fls_given);
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
  if (parameters_.flip_primary) primary_.Invert();
  if (parameters_.flip_secondary) secondary_.Invert();
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

bool FEMixtureContact::check_parameters() {
  const std::vector<std::string> wrong = complaints(parameters_);
  for (const std::string& sentence : wrong)
    feLogError("sliding-mixture \"%s\": %s", GetName().c_str(), sentence.c_str());
  for (const std::string& sentence : notices(parameters_))
    feLog("sliding-mixture \"%s\": %s\n", GetName().c_str(), sentence.c_str());
  if (m_psf != 1 || m_psfmax != 0)
    feLog("sliding-mixture \"%s\": <penalty_sf> and <max_penalty_sf> have no effect: penalties grow by themselves.\n",
          GetName().c_str());
  const auto* mechanics = dynamic_cast<const FEMechModel*>(GetFEModel());
  const bool unfit = parameters_.extrapolation && mechanics != nullptr && mechanics->RigidBodies() > 0;
  if (unfit)
    feLogError("sliding-mixture \"%s\": <extrapolation> is not available in models with rigid bodies; set it to 0.",
               GetName().c_str());
  return wrong.empty() && !unfit;
}

namespace {

std::set<std::vector<int>> facet_nodes(FESurface& surface) {
  std::set<std::vector<int>> facets;
  for (int i = 0; i < surface.Elements(); ++i) {
    std::vector<int> nodes = surface.Element(i).m_node;
    std::sort(nodes.begin(), nodes.end());
    facets.insert(nodes);
  }
  return facets;
}

bool is_triangular(const FESurfaceElement& element) {
  return element.Shape() == ET_TRI3 || element.Shape() == ET_TRI6 || element.Shape() == ET_TRI7 ||
         element.Shape() == ET_TRI10;
}

std::optional<FacetType> type_of(const FESurfaceElement& element) {
  return facet_type(is_triangular(element), element.Nodes());
}

}  // namespace

bool FEMixtureContact::check_surfaces() {
  for (const Side side : both_sides) {
    FEMixtureSurface& s = surface(side);
    for (int i = 0; i < s.Elements(); ++i) {
      if (type_of(s.Element(i))) continue;
      feLogError(
          "sliding-mixture \"%s\": surface \"%s\" has a facet with %d nodes, which is not supported. Allowed are facets with 3, 6 "
          "or 7 (triangles) and 4, 8 or 9 nodes (quadrilaterals).",
          GetName().c_str(), s.GetName().c_str(), s.Element(i).Nodes());
      return false;
    }
  }
  const auto one = facet_nodes(primary_);
  const auto two = facet_nodes(secondary_);
  const bool shared = std::any_of(one.begin(), one.end(), [&](const auto& facet) { return two.count(facet) > 0; });
  if (shared) {
    feLogError(
        "sliding-mixture \"%s\": the surfaces \"%s\" and \"%s\" share facets. A surface cannot be in contact with itself; the "
        "primary and secondary surface of the surface pair must be different.",
        GetName().c_str(), primary_.GetName().c_str(), secondary_.GetName().c_str());
  }
  return !shared;
}

std::optional<PerSide<std::vector<FacetMaterial>>> FEMixtureContact::materials() {
  PerSide<std::vector<FacetMaterial>> materials;
  for (const Side side : both_sides) {
    FEMixtureSurface& s = surface(side);
    for (int i = 0; i < s.Elements(); ++i) {
      std::string problem;
      const auto material = facet_material(*GetFEModel(), s, s.Element(i), problem);
      if (!material) {
        feLogError("sliding-mixture \"%s\": surface \"%s\": %s.", GetName().c_str(), s.GetName().c_str(),
                   problem.c_str());
        return std::nullopt;
      }
      materials[side].push_back(*material);
    }
  }
  return materials;
}

bool FEMixtureContact::read_materials() {
  const auto found = materials();
  if (!found || !decide_effects(*found)) return false;
  if (effects_.scalar_fields() > max_scalar_fields) {
    feLogError("sliding-mixture \"%s\": the surfaces share %d fields; at most %d are supported.", GetName().c_str(),
               effects_.scalar_fields(), max_scalar_fields);
    return false;
  }
  build_core({{surface_mesh(Side::primary, (*found)[Side::primary]),
               surface_mesh(Side::secondary, (*found)[Side::secondary])}});
  const VectorXd& penalty = core_->pass(0).penalty().traction;
  if (!penalty.allFinite()) {
    feLogError(
        "sliding-mixture \"%s\": both surfaces are rigid, so there is no stiffness to choose a penalty from. Set <penalty> "
        "to a value [force/length^3] and <auto_penalty> to 0.",
        GetName().c_str());
  }
  return penalty.allFinite() && check_multipliers();
}

bool FEMixtureContact::check_multipliers() {
  if (core_->multiplier_layout().size() == 0 || deformable_node() >= 0) return true;
  feLogError(
      "sliding-mixture \"%s\": both surfaces are rigid, so there is nothing that <laugon>LAGMULT</laugon> could be solved for. "
      "Use PENALTY or AUGLAG.",
      GetName().c_str());
  return false;
}

void FEMixtureContact::build_core(PerSide<SurfaceMesh> meshes) {
  core_ = std::make_unique<ContactInterface>(std::move(meshes), effects_, core_settings(parameters_));
}

std::vector<FieldAtContact> FEMixtureContact::fields_of_model(const PerSide<std::vector<FacetMaterial>>& materials) {
  const auto obstacles = [&](const auto& has, const char* lacking) {
    std::vector<std::string> list;
    for (const Side side : both_sides) {
      if (std::none_of(materials[side].begin(), materials[side].end(), has))
        list.push_back("\"" + surface(side).GetName() + "\" " + lacking);
    }
    return list;
  };
  std::vector<FieldAtContact> fields;
  fields.push_back({-1, "", {"the module has no fluid pressure"}});
  if (pressure_dof_ >= 0)
    fields.back().obstacles = obstacles([](const FacetMaterial& m) { return m.permeable; }, "is impermeable");
  std::vector<std::string> names = solute_names(*GetFEModel());
  names.resize(static_cast<std::size_t>(concentrations_));
  for (int solute = 0; solute < concentrations_; ++solute) {
    const auto has_it = [solute](const FacetMaterial& m) { return m.solutes.count(solute) > 0; };
    fields.push_back({solute, names[static_cast<std::size_t>(solute)], obstacles(has_it, "does not have it")});
  }
  return fields;
}

bool FEMixtureContact::decide_effects(const PerSide<std::vector<FacetMaterial>>& materials) {
  fields_at_contact_ = fields_of_model(materials);
  const Exchange exchange = decide_exchange(parameters_.effects, fields_at_contact_, Motion::undecided);
  for (const std::string& sentence : exchange.complaints)
    feLogError("sliding-mixture \"%s\": %s", GetName().c_str(), sentence.c_str());
  if (!exchange.complaints.empty()) return false;
  effects_ = exchange.effects;
  return true;
}

Motion FEMixtureContact::motion() {
  const auto fixed = [&](const FENode& node) {
    return node.m_rid < 0 && std::all_of(
                                 displacement_dofs_.begin(), displacement_dofs_.end(),
                                 [&](int dof) { return node.get_bc(dof) == DOF_FIXED; });
  };
  for (const Side side : both_sides) {
    FEMixtureSurface& s = surface(side);
    for (int i = 0; i < s.Nodes(); ++i) {
      if (!fixed(s.Node(i))) return Motion::possible;
    }
  }
  return Motion::impossible;
}

void FEMixtureContact::decide_traction() {
  // Only a step's own boundary conditions tell whether anything can move in it. A continued run has not read materials.
  if (fields_at_contact_.empty()) {
    if (const auto found = materials()) fields_at_contact_ = fields_of_model(*found);
  }
  const Exchange exchange = decide_exchange(parameters_.effects, fields_at_contact_, motion());
  may_run_ = exchange.complaints.empty();
  for (const std::string& sentence : exchange.complaints)
    feLogError("sliding-mixture \"%s\": %s", GetName().c_str(), sentence.c_str());
  if (exchange.effects.traction != effects_.traction) {
    effects_.traction = exchange.effects.traction;
    core_->exchange_traction(effects_.traction);
  }
  if (std::exchange(summary_, exchange.summary) != exchange.summary)
    feLog("sliding-mixture \"%s\" exchanges %s\n", GetName().c_str(), exchange.summary.c_str());
}

SurfaceMesh FEMixtureContact::surface_mesh(Side side, const std::vector<FacetMaterial>& materials) {
  FEMixtureSurface& s = surface(side);
  const auto facets = static_cast<Index>(materials.size());
  SurfaceMesh mesh;
  mesh.nodes = s.Nodes();
  mesh.stiffness.resize(facets);
  mesh.conductance.setZero(effects_.scalar_fields(), facets);
  for (Index f = 0; f < facets; ++f) {
    const FESurfaceElement& element = s.Element(static_cast<int>(f));
    Facet facet;
    facet.type = type_of(element).value_or(FacetType::quad4);  // check_surfaces() has seen to it that there is a type
    std::copy_n(element.m_lnode.begin(), element.Nodes(), facet.nodes.begin());
    mesh.facets.push_back(facet);

    const FacetMaterial& material = materials[static_cast<std::size_t>(f)];
    mesh.stiffness[f] = material.stiffness;
    FieldMask known = 0;
    int field = 0;
    if (effects_.solvent) {
      if (material.permeable) known |= only(field);
      mesh.conductance(field++, f) = material.permeability;
    }
    for (const int solute : effects_.solutes) {
      const auto entry = material.solutes.find(solute);
      if (entry != material.solutes.end()) {
        known |= only(field);
        mesh.conductance(field, f) = entry->second;
      }
      ++field;
    }
    mesh.permeable.push_back(known);
  }
  return mesh;
}

bool FEMixtureContact::update_properties() {
  PerSide<VectorXd> stiffness;
  PerSide<MatrixXd> conductance;
  const auto found = materials();
  if (!found) return false;
  for (const Side side : both_sides) {
    const SurfaceMesh mesh = surface_mesh(side, (*found)[side]);
    stiffness[side] = mesh.stiffness;
    conductance[side] = mesh.conductance;
  }
  core_->update_properties(stiffness, conductance);
  return true;
}

bool FEMixtureContact::check_ambient() {
  for (const FEMixtureAmbientConcentration* ambient : ambient_concentrations_) {
    if (ambient->solute < 0 || ambient->solute > concentrations_) {
      feLogError(
          "sliding-mixture \"%s\": <ambient_concentration sol=\"%d\"> names a solute that the model does not have. It has %d.",
          GetName().c_str(), ambient->solute, concentrations_);
      return false;
    }
    if (ambient->solute == 0 && concentrations_ != 1) {
      feLogError(
          "sliding-mixture \"%s\": <ambient_concentration> needs the attribute sol=\"...\" to say which of the model's %d solutes "
          "it is for.",
          GetName().c_str(), concentrations_);
      return false;
    }
  }
  return true;
}

int FEMixtureContact::InitEquations(int first) {
  first_equation_ = first;
  decide_traction();
  multiplier_node_ = deformable_node();
  return static_cast<int>(core_->multiplier_layout().size());
}

void FEMixtureContact::Activate() {
  FEContactInterface::Activate();
  if (parameters_.node_reloc && !relocated_) relocate_nodes();
  update_properties();
  ask_for_nonsymmetric_matrix();
  Update();
}

void FEMixtureContact::ask_for_nonsymmetric_matrix() {
  if (parameters_.symmetric_stiffness) return;
  FEModel& model = *GetFEModel();
  for (int i = model.GetCurrentStepIndex(); i < model.Steps(); ++i) {
    FESolver* solver = model.GetStep(i)->GetFESolver();
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
  ambient_.synchronise();
  if (reads_properties_again(parameters_)) update_properties();
  if (core_->multiplier_layout().size() > 0) step_start_ = core_->unknown_multipliers();
}

// ------------------------------------------------------------ model state

int FEMixtureContact::field_dof(int field) const {
  if (effects_.solvent && field == 0) return pressure_dof_;
  return concentration_dof_ + effects_.solutes[static_cast<std::size_t>(field - (effects_.solvent ? 1 : 0))];
}

Matrix3Xd FEMixtureContact::positions(Side side) {
  FEMixtureSurface& s = surface(side);
  Matrix3Xd x(3, s.Nodes());
  for (int i = 0; i < s.Nodes(); ++i) {
    const vec3d& r = s.Node(i).m_rt;
    x.col(i) << r.x, r.y, r.z;
  }
  return x;
}

PerSide<SurfaceFields> FEMixtureContact::fields() {
  PerSide<SurfaceFields> all;
  for (const Side side : both_sides) {
    FEMixtureSurface& s = surface(side);
    all[side].position = positions(side);
    all[side].scalar.resize(s.Nodes(), effects_.scalar_fields());
    for (int k = 0; k < effects_.scalar_fields(); ++k) {
      const int dof = field_dof(k);
      for (int i = 0; i < s.Nodes(); ++i) all[side].scalar(i, k) = s.Node(i).get(dof);
    }
  }
  return all;
}

void FEMixtureContact::project() {
  const TaskClock timed = core_->clock(Task::search);
  const FESolver* solver = GetFEModel()->GetCurrentStep()->GetFESolver();
  const bool keep_facets = parameters_.seg_up > 0 && solver->m_niter > parameters_.seg_up;
  core_->project({{positions(Side::primary), positions(Side::secondary)}},
                 keep_facets ? ContactInterface::Search::same_facets : ContactInterface::Search::everywhere);
}

void FEMixtureContact::relocate_nodes() {
  const Matrix3Xd moved = core_->without_overlap({{positions(Side::primary), positions(Side::secondary)}});
  for (int i = 0; i < primary_.Nodes(); ++i) {
    FENode& node = primary_.Node(i);
    node.m_rt = vec3d(moved(0, i), moved(1, i), moved(2, i));
    node.m_r0 = node.m_rt;
  }
  // Elements keep their reference Jacobians, which FEBio evaluates at its start alone.
  FEMesh& mesh = GetFEModel()->GetMesh();
  for (int i = 0; i < mesh.Domains(); ++i) {
    auto* domain = dynamic_cast<FESolidDomain*>(&mesh.Domain(i));
    if (domain != nullptr) domain->FESolidDomain::Init();
  }
  relocated_ = true;
}

void FEMixtureContact::Update() {
  project();
  if (std::exchange(in_trial_, false)) {
    // Contact changes where a matrix is formed: where it must change, quasi-Newton methods have to form one.
    if (newton_solver() != nullptr && !core_->is_solution(fields())) newton_solver()->QNForceReform(true);
    return;
  }
  // The start of a step, or an augmentation. FEBio has evaluated the bodies already in this pass: ask for it again if
  // an ambient value changed.
  if (!std::exchange(keep_prediction_, false)) {
    core_->end_iterations();
    clamped_.release();
    clamped_.resume();
    tried_ = false;
  }
  if (begin_iteration()) GetFEModel()->SetMeshUpdateFlag(true);
  begun_ = true;
}

void FEMixtureContact::Update(const std::vector<double>& total, const std::vector<double>& increment) {
  // A trial: status and linearised gaps are those that the iteration began with.
  set_multipliers(total, increment);
  project();
  in_trial_ = tried_ = true;
  begun_ = false;
}

void FEMixtureContact::set_multipliers(const std::vector<double>& total, const std::vector<double>& increment) {
  const Index count = core_->multiplier_layout().size();
  if (count == 0) return;
  const auto of_contact = [&](const std::vector<double>& all) {
    return Eigen::Map<const VectorXd>(all.data() + first_equation_, count);
  };
  core_->set_unknown_multipliers(step_start_ + of_contact(total) + of_contact(increment));
}

void FEMixtureContact::UpdateIncrements(std::vector<double>& total, const std::vector<double>& increment) {
  // FEBio's solver for solids leaves equations that are not nodes' to their owners.
  const auto first = static_cast<std::size_t>(first_equation_);
  const auto count = static_cast<std::size_t>(core_->multiplier_layout().size());
  for (std::size_t n = first; n < first + count; ++n) total[n] += increment[n];
}

FENewtonSolver* FEMixtureContact::newton_solver() {
  return dynamic_cast<FENewtonSolver*>(GetFEModel()->GetCurrentStep()->GetFESolver());
}

bool FEMixtureContact::begin_iteration() {
  const TaskClock timed = core_->clock(Task::stiffness);
  loads_changed_ = core_->begin_iteration(fields());
  // Ambient conditions depend on all contacts: the last one applies them.
  const std::vector<FEMixtureContact*> contacts = active_contacts();
  if (contacts.empty() || contacts.back() != this) return false;
  const bool ambient_changed = apply_ambient(contacts);
  const bool clamp_changed = tried_ && clamped_.update();
  return ambient_changed || clamp_changed ||
         std::any_of(contacts.begin(), contacts.end(),
                     [](const FEMixtureContact* contact) { return contact->loads_changed_; });
}

bool FEMixtureContact::leads_extrapolation() {
  // It concerns the whole model: one contact does it for all.
  const std::vector<FEMixtureContact*> contacts = active_contacts();
  return !contacts.empty() && contacts.front() == this &&
         std::any_of(contacts.begin(), contacts.end(),
                     [](const FEMixtureContact* contact) { return contact->parameters_.extrapolation; });
}

void FEMixtureContact::begin_at_expected_state() {
  if (tried_ || !leads_extrapolation() || !extrapolation_.move_to_expected_state(*newton_solver())) return;
  for (FEMixtureContact* contact : active_contacts()) contact->moved_ = true;
}

void FEMixtureContact::BuildMatrixProfile(FEGlobalMatrix& matrix) {
  // A matrix is about to be formed for the next iteration, at an accepted state. FEBio has evaluated the residual of
  // that state already, with the loads that were held then; it is to be evaluated again when the matrix is done. At the
  // start of a step and after an augmentation Update() has begun the iteration: FEBio's residual is the right one, and
  // of what the last iteration predicted nothing is left to decide by.
  begin_at_expected_state();
  const bool begun = std::exchange(begun_, false);
  if (std::exchange(moved_, false)) {
    core_->move_iteration(fields());
  } else if (!begun && begin_iteration()) {
    for (FEMixtureContact* contact : active_contacts()) contact->in_trial_ = true;
    newton_solver()->UpdateModel();
    residual_outdated_ = true;
  }
  add_to_profile(matrix);
}

bool FEMixtureContact::on_matrix_reformed(FEModel* /*fem*/, unsigned int /*when*/, void* contact) {
  auto* self = static_cast<FEMixtureContact*>(contact);
  FENewtonSolver* solver = self->newton_solver();
  if (!self->IsActive() || solver == nullptr) return true;
  self->extrapolation_.complete_residual(*solver);
  if (!std::exchange(self->residual_outdated_, false)) return true;
  solver->Residual(solver->m_R0);
  solver->m_R0 += solver->m_Fd;  // what prescribed increments add, at the start of a step
  return true;
}

// ------------------------------------------------------------ ambient conditions

std::vector<FEMixtureContact*> FEMixtureContact::active_contacts() {
  std::vector<FEMixtureContact*> contacts;
  FEModel& fem = *GetFEModel();
  for (int i = 0; i < fem.SurfacePairConstraints(); ++i) {
    auto* contact = dynamic_cast<FEMixtureContact*>(fem.SurfacePairConstraint(i));
    if (contact && contact->IsActive()) contacts.push_back(contact);
  }
  return contacts;
}

double FEMixtureContact::ambient_value(int dof) const {
  if (dof == pressure_dof_) return parameters_.ambient_pressure;
  for (const FEMixtureAmbientConcentration* ambient : ambient_concentrations_) {
    const int solute = ambient->solute > 0 ? ambient->solute - 1 : 0;
    if (dof == concentration_dof_ + solute) return ambient->value;
  }
  return 0;
}

bool FEMixtureContact::apply_ambient(const std::vector<FEMixtureContact*>& contacts) {
  // A node is at ambient only where no contact has it.
  if (pressure_dof_ < 0) return false;
  struct NodeStatus {
    bool in_contact;
    FEMixtureContact* ambient;
  };
  std::map<FENode*, NodeStatus> nodes;
  for (FEMixtureContact* contact : contacts) {
    const auto in_contact = contact->core_->nodes_in_contact();
    for (const Side side : both_sides) {
      FEMixtureSurface& s = contact->surface(side);
      for (int i = 0; i < s.Nodes(); ++i) {
        NodeStatus& status = nodes.insert({&s.Node(i), {false, contact}}).first->second;
        status.in_contact = status.in_contact || in_contact[side][static_cast<std::size_t>(i)];
      }
    }
  }
  bool changed = false;
  const auto apply = [&](FENode& node, const NodeStatus& status, int dof) {
    if (!AmbientNodes::is_free(node, dof)) return;
    if (clamped_.holds(node, dof)) {
      if (status.in_contact) return;
      clamped_.forget(node, dof);
    }
    const bool switched = status.in_contact ? ambient_.release(node, dof)
                                            : AmbientNodes::hold_at(node, dof, status.ambient->ambient_value(dof));
    changed = changed || switched;
  };
  for (auto& [node, status] : nodes) {
    apply(*node, status, pressure_dof_);
    for (int k = 0; k < concentrations_; ++k) apply(*node, status, concentration_dof_ + k);
  }
  return changed;
}

// ------------------------------------------------------------ assembly

std::vector<int> FEMixtureContact::node_ids(const ContactInterface::Location& at) {
  std::vector<int> nodes;
  for (const int node : at.patch.primary) nodes.push_back(surface(at.first).NodeIndex(node));
  for (const int node : at.patch.secondary) nodes.push_back(surface(other(at.first)).NodeIndex(node));
  if (at.patch.multiplier_node) nodes.push_back(multiplier_node_);
  return nodes;
}

int FEMixtureContact::deformable_node() {
  for (const Side side : both_sides) {
    FEMixtureSurface& s = surface(side);
    for (int i = 0; i < s.Nodes(); ++i) {
      if (s.Node(i).m_rid < 0) return s.NodeIndex(i);
    }
  }
  return -1;
}

std::vector<int> FEMixtureContact::equations(const ContactInterface::Location& at, const std::vector<int>& nodes) {
  const LocalLayout layout = at.patch.layout();
  FEMesh& mesh = GetFEModel()->GetMesh();
  std::vector<int> ids(static_cast<std::size_t>(layout.size()), -1);
  if (at.patch.multiplier_node) {
    const MultiplierLayout own = core_->multiplier_layout();
    const int node = *at.patch.multiplier_node;
    const auto equation = [&](Index multiplier) { return first_equation_ + static_cast<int>(multiplier); };
    if (layout.has_displacements())
      ids[static_cast<std::size_t>(layout.traction_multiplier())] = equation(own.traction(node));
    for (Index k = 0; k < layout.scalar_fields(); ++k) {
      const int field = at.patch.fields[static_cast<std::size_t>(k)];
      ids[static_cast<std::size_t>(layout.flux_multiplier(k))] = equation(own.flux(node, field));
    }
  }
  for (Index node = 0; node < layout.nodes(); ++node) {
    const std::vector<int>& id = mesh.Node(nodes[static_cast<std::size_t>(node)]).m_ID;
    for (std::size_t i = 0; layout.has_displacements() && i < 3; ++i) {
      ids[static_cast<std::size_t>(layout.displacement(node, static_cast<Index>(i)))] = id[static_cast<std::size_t>(
          displacement_dofs_[i])];
    }
    for (Index k = 0; k < layout.scalar_fields(); ++k) {
      const int dof = field_dof(at.patch.fields[static_cast<std::size_t>(k)]);
      ids[static_cast<std::size_t>(layout.scalar(node, k))] = id[static_cast<std::size_t>(dof)];
    }
  }
  return ids;
}

void FEMixtureContact::add_to_profile(FEGlobalMatrix& matrix) {
  const TaskClock timed = core_->clock(Task::stiffness);
  // Rigid nodes bring the equations of their body's rotations in as well.
  FEModel& fem = *GetFEModel();
  const std::array<int, 3> rotation{fem.GetDOFIndex("Ru"), fem.GetDOFIndex("Rv"), fem.GetDOFIndex("Rw")};
  core_->for_each_coupling([&](const ContactInterface::Location& at) {
    const std::vector<int> nodes = node_ids(at);
    std::vector<int> ids = equations(at, nodes);
    for (const int node : nodes) {
      for (const int dof : rotation) {
        if (dof >= 0 && at.patch.displacements)
          ids.push_back(fem.GetMesh().Node(node).m_ID[static_cast<std::size_t>(dof)]);
      }
    }
    matrix.build_add(ids);
  });
}

void FEMixtureContact::LoadVector(FEGlobalVector& residual, const FETimeInfo& time) {
  const TaskClock timed = core_->clock(Task::residual);
  core_->residual(fields(), time.timeIncrement, [&](const ContactInterface::Location& at, const VectorXd& values) {
    std::vector<int> nodes = node_ids(at);
    std::vector<int> ids = equations(at, nodes);
    std::vector<double> entries(values.data(), values.data() + values.size());
    residual.Assemble(nodes, ids, entries);
  });
}

namespace {

/// Where the entries of a layout stand in another over the same nodes and fields that has displacements, too.
std::vector<Index> places(const LocalLayout& layout, const LocalLayout& all) {
  std::vector<Index> places(static_cast<std::size_t>(layout.size()));
  for (Index block = 0; block < layout.blocks(); ++block) {
    for (Index i = 0; layout.has_displacements() && i < 3; ++i) {
      places[static_cast<std::size_t>(layout.displacement(block, i))] = all.displacement(block, i);
    }
    for (Index k = 0; k < layout.scalar_fields(); ++k) {
      places[static_cast<std::size_t>(layout.scalar(block, k))] = all.scalar(block, k);
    }
  }
  return places;
}

/// Equations at their places in a larger layout, and none elsewhere.
std::vector<int> spread(const std::vector<int>& equations, const std::vector<Index>& places, const LocalLayout& all) {
  std::vector<int> result(static_cast<std::size_t>(all.size()), -1);
  for (std::size_t i = 0; i < equations.size(); ++i) result[static_cast<std::size_t>(places[i])] = equations[i];
  return result;
}

}  // namespace

void FEMixtureContact::StiffnessMatrix(FELinearSystem& system, const FETimeInfo& time) {
  const TaskClock timed = core_->clock(Task::stiffness);
  const auto add = [&](const ContactInterface::Location& rows, const ContactInterface::Location& columns,
                       const MatrixXd& values) {
    // FEBio takes square matrices alone, with blocks of one size per node that begin with displacements. What a block
    // lacks of them has no equations.
    Patch all = columns.patch;
    all.displacements = true;
    const LocalLayout layout = all.layout();
    const std::vector<int> nodes = node_ids(columns);
    const std::vector<Index> row_places = places(rows.patch.layout(), layout);
    const std::vector<Index> column_places = places(columns.patch.layout(), layout);
    const int size = static_cast<int>(layout.size());
    FEElementMatrix stiffness;
    stiffness.resize(size, size);
    stiffness.zero();
    // FEBio solves K du = R with K = -dR/du.
    for (Index i = 0; i < values.rows(); ++i) {
      double* row = stiffness[static_cast<int>(row_places[static_cast<std::size_t>(i)])];
      for (Index j = 0; j < values.cols(); ++j) row[column_places[static_cast<std::size_t>(j)]] = -values(i, j);
    }
    stiffness.SetNodes(nodes);
    stiffness.SetIndices(spread(equations(rows, nodes), row_places, layout),
                         spread(equations(columns, nodes), column_places, layout));
    system.Assemble(stiffness);
  };
  core_->tangent(fields(), time.timeIncrement, add);
}

// ------------------------------------------------------------ augmentation

bool FEMixtureContact::Augment(int augmentation, const FETimeInfo& /*time*/) {
  const TaskClock timed = core_->clock(Task::augmentation);
  // FEBio has converged with the status and gaps that were held: it is a solution only if the true laws agree.
  if (!core_->is_solution(fields()) || !clamped_.settled()) {
    // FEBio counts reformations anew after this: the limit on them is to hold all the same.
    if (++disputes_ > newton_solver()->m_maxref) throw MaxStiffnessReformations();
    keep_prediction_ = true;
    return false;
  }
  const Settings& settings = core_->settings();
  if (settings.enforcement == Enforcement::penalty) return true;
  const PerSide<SurfaceFields> current = fields();
  const GapReport report = core_->gaps(current);
  log_gaps(augmentation, report);
  if (settings.enforcement == Enforcement::lagrange_multipliers) return true;  // is_solution() has seen to the gaps
  const bool met = core_->converged(report);
  if (met && augmentation >= settings.min_augmentations) return true;
  if (augmentation >= settings.max_augmentations) {
    feLogWarning("sliding-mixture \"%s\": %d augmentations (maxaug) were not enough to meet the tolerances.",
                 GetName().c_str(), augmentation);
    return true;
  }
  core_->augment(current);
  return false;
}

void FEMixtureContact::log_gaps(int augmentation, const GapReport& report) {
  const Tolerances& tolerances = core_->settings().tolerances;
  const auto row = [&](const std::string& name, const FieldGap& gap, const Tolerances::Field& tolerance) {
    feLog("    %-16s %12.4le (%9.2le)  %12.4le (%9.2le)\n", name.c_str(), gap.relative, tolerance.relative, gap.largest,
          tolerance.largest);
  };
  feLog(" sliding-mixture \"%s\", augmentation %d: gaps, with the tolerances (0: none)\n", GetName().c_str(),
        augmentation);
  feLog("                         RELATIVE                  LARGEST\n");
  row("gap", report.traction, tolerances.traction);
  for (std::size_t k = 0; k < report.flux.size(); ++k) {
    const bool solvent = effects_.solvent && k == 0;
    const std::string name = solvent ? "pressure jump"
                                     : "jump of c" +
                                           std::to_string(field_dof(static_cast<int>(k)) - concentration_dof_ + 1);
    row(name, report.flux[k], solvent ? tolerances.solvent : tolerances.solute);
  }
}

// ------------------------------------------------------------ output, restart

void FEMixtureContact::store_output() {
  const TaskClock timed = core_->clock(Task::output);
  const PerSide<SurfaceFields> current = fields();
  Balance total = core_->balance(current);
  primary_.store_output(core_->nodal_output(Side::primary, current), total);
  total.force = -total.force;
  total.flow = -total.flow;
  secondary_.store_output(core_->nodal_output(Side::secondary, current), total);
}

bool FEMixtureContact::on_step_solved(FEModel* /*fem*/, unsigned int /*when*/, void* contact) {
  auto* self = static_cast<FEMixtureContact*>(contact);
  if (!self->IsActive()) return true;
  self->store_output();
  self->clamped_.end_step();
  if (self->leads_extrapolation()) self->extrapolation_.step_solved();
  return true;
}

bool FEMixtureContact::on_solved(FEModel* fem, unsigned int /*when*/, void* contact) {
  auto* self = static_cast<FEMixtureContact*>(contact);
  const std::vector<std::string> table = price_table(self->GetName(), *self->core_, self->run_.peek());
  feLogEx(fem, "\n");
  for (const std::string& line : table) feLogEx(fem, "%s\n", line.c_str());
  return true;
}

namespace {

void archive_mesh(DumpStream& ar, SurfaceMesh& mesh) {
  int facets = static_cast<int>(mesh.facets.size());
  ar & mesh.nodes & facets;
  mesh.facets.resize(static_cast<std::size_t>(facets));
  mesh.permeable.resize(static_cast<std::size_t>(facets));
  for (Facet& facet : mesh.facets) {
    int type = static_cast<int>(facet.type);
    ar & type;
    facet.type = static_cast<FacetType>(type);
    for (int& node : facet.nodes) ar & node;
  }
  for (FieldMask& mask : mesh.permeable) {
    // Dump streams know no 64-bit integers.
    int low = static_cast<int>(static_cast<std::uint32_t>(mask));
    int high = static_cast<int>(static_cast<std::uint32_t>(mask >> 32U));
    ar & low & high;
    mask = static_cast<FieldMask>(static_cast<std::uint32_t>(low)) |
           static_cast<FieldMask>(static_cast<std::uint32_t>(high)) << 32U;
  }
  archive(ar, mesh.stiffness);
  archive(ar, mesh.conductance);
}

void archive_multipliers(DumpStream& ar, Multipliers& multipliers) {
  archive(ar, multipliers.traction);
  archive(ar, multipliers.flux);
  archive(ar, multipliers.traction_growth);
  archive(ar, multipliers.flux_growth);
}

}  // namespace

void FEMixtureContact::Serialize(DumpStream& ar) {
  FEContactInterface::Serialize(ar);
  primary_.Serialize(ar);
  secondary_.Serialize(ar);
  if (!ar.IsShallow()) {
    ar & pressure_dof_ & concentration_dof_ & concentrations_ & relocated_ & first_equation_ & multiplier_node_;
    for (int& dof : displacement_dofs_) ar & dof;
    archive(ar, step_start_);
    ar & effects_.traction & effects_.solvent & effects_.solutes;
    ar & parameters_.traction_tolerance_given & parameters_.solvent_tolerance_given &
        parameters_.solute_tolerance_given;
    ar & parameters_.penalty_given & parameters_.pressure_penalty_given & parameters_.concentration_penalty_given;
    ar & parameters_.search_radius_given;
    PerSide<SurfaceMesh> meshes;
    for (const Side side : both_sides) {
      if (ar.IsSaving()) meshes[side] = core_->mesh(side);
      archive_mesh(ar, meshes[side]);
    }
    if (!ar.IsSaving()) build_core(std::move(meshes));
  }
  for (std::size_t pass = 0; pass < core_->passes(); ++pass) archive_multipliers(ar, core_->multipliers(pass));
  if (ar.IsSaving()) return;
  core_->end_iterations();
  in_trial_ = keep_prediction_ = begun_ = false;  // a trial that was cut back is over
  residual_outdated_ = moved_ = false;
  extrapolation_.skip();
  add_callbacks();
}
