#include "mixture_contact.h"

#include <FEBioMech/FEExplicitSolidSolver.h>
#include <FECore/FEAnalysis.h>
#include <FECore/FEException.h>
#include <FECore/FEGlobalMatrix.h>
#include <FECore/FEMesh.h>
#include <FECore/FEModel.h>
#include <FECore/FEModifiedNewtonStrategy.h>
#include <FECore/FESolidDomain.h>

#include <algorithm>
#include <map>
#include <utility>

using namespace mixture_contact;

// Newton iterations: the model's state, the contact's status in it, ambient conditions outside.

namespace {

/// Whether a solver may go on with the matrix of an earlier iteration: all but full Newton.
bool keeps_matrices(const FENewtonSolver* solver) {
  if (solver == nullptr) return false;
  const FENewtonStrategy* strategy = solver->m_qnstrategy;
  return strategy->m_maxups > 0 || dynamic_cast<const FEModifiedNewtonStrategy*>(strategy) != nullptr;
}

}  // namespace

int FEMixtureContact::field_dof(int field) const {
  const int solute = solute_of(effects_, field);
  return solute < 0 ? pressure_dof_ : concentration_dof_ + solute;
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
  // FEBio prepares no steps for contacts where its solver is none of Newton's kind.
  if (newton_solver() == nullptr && !follow_load_curves()) throw FatalError();
  project();
  if (std::exchange(in_trial_, false)) {
    // Contact changes where a matrix is formed: where it must change, quasi-Newton methods have to form one.
    if (keeps_matrices(newton_solver()) && !core_->is_solution(fields())) newton_solver()->QNForceReform(true);
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
  line_search_.tried(newton_solver(), increment);
  begun_ = at_step_start_ = false;
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

SolverKind FEMixtureContact::solver_kind() {
  if (newton_solver() != nullptr) return SolverKind::newton;
  const auto* dynamics = dynamic_cast<FEExplicitSolidSolver*>(GetFEModel()->GetCurrentStep()->GetFESolver());
  return dynamics == nullptr ? SolverKind::conjugate_gradient : SolverKind::explicit_dynamics;
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
  return !contacts.empty() && contacts.front() == this && StepExtrapolation::is_available(*GetFEModel()) &&
         StepExtrapolation::suits(newton_solver()) &&
         std::any_of(contacts.begin(), contacts.end(),
                     [](const FEMixtureContact* contact) { return contact->parameters_.extrapolation; });
}

void FEMixtureContact::begin_at_expected_state() {
  if (!at_step_start_ || !leads_extrapolation()) return;
  const std::vector<FEMixtureContact*> contacts = active_contacts();
  const auto clamp = [&] {
    if (contacts.back()->clamped_.update_at_new_state()) update_model_in_trial();
  };
  if (!extrapolation_.move_to_expected_state(*newton_solver(), clamp)) return;
  for (FEMixtureContact* contact : contacts) contact->moved_ = true;
}

void FEMixtureContact::update_model_in_trial() {
  for (FEMixtureContact* contact : active_contacts()) contact->in_trial_ = true;
  newton_solver()->UpdateModel();
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
    const std::vector<FEMixtureContact*> contacts = active_contacts();
    if (contacts.back() == this && apply_ambient(contacts)) update_model_in_trial();
  } else if (!begun && begin_iteration()) {
    update_model_in_trial();
    residual_outdated_ = true;
  }
  add_to_profile(matrix);
}

bool FEMixtureContact::on_matrix_reformed(FEModel* /*fem*/, unsigned int /*when*/, void* contact) {
  auto* self = static_cast<FEMixtureContact*>(contact);
  FENewtonSolver* solver = self->newton_solver();
  if (!self->IsActive() || solver == nullptr) return true;
  solver->m_breshape = true;  // the next iteration begins in BuildMatrixProfile
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
    const auto in_contact = contact->core_->hold_nodes_in_contact();
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
