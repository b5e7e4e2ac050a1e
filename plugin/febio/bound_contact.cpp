#include "bound_contact.h"

#include "archive.h"
#include "contact/base/parallel.h"
#include "contact/interface/multipliers.h"
#include "core_archive.h"
#include "host/warnings.h"
#include "present_step.h"

#include <FEBioMech/FEMechModel.h>
#include <FEBioMech/FERigidBody.h>
#include <FECore/FEAnalysis.h>
#include <FECore/FEMesh.h>
#include <FECore/FEModel.h>
#include <FECore/FESolver.h>

#include <algorithm>
#include <map>
#include <utility>

using namespace mixture_contact;

namespace {

/// True if no primary node is in contact.
bool is_open(const ContactInterface& contact) {
  const NodeFlags nodes = contact.nodes_in_contact()[Side::primary];
  return std::none_of(nodes.begin(), nodes.end(), [](bool closed) { return closed; });
}

RigidPose pose_of(const FERigidBody& body) {
  const quatd q = body.GetRotation();
  return {{body.m_rt.x, body.m_rt.y, body.m_rt.z}, Eigen::Quaterniond(q.w, q.x, q.y, q.z)};
}

/// The rigid bodies to which nodes of a surface belong.
RigidParts rigid_parts(FEMixtureSurface& surface) {
  RigidParts parts;
  auto* const mechanics = dynamic_cast<FEMechModel*>(surface.GetFEModel());
  std::map<int, int> found;
  for (int i = 0; mechanics != nullptr && i < surface.Nodes(); ++i) {
    const int id = surface.Node(i).m_rid;
    if (id < 0) continue;
    const auto [entry, is_new] = found.try_emplace(id, number_of(parts.poses));
    if (is_new) parts.poses.push_back(pose_of(*mechanics->GetRigidBody(id)));
    if (parts.body.empty()) parts.body.assign(indexing::entries(surface.Nodes()), -1);
    parts.body[i] = entry->second;
  }
  return parts;
}

}  // namespace

PerSide<SurfaceFields> fields_of(const DofMap& dofs, const Effects& effects) {
  ContactSurfaces& surfaces = dofs.surfaces();
  PerSide<SurfaceFields> all;
  PerSide<Matrix3Xd> x = surfaces.positions();
  for (const Side side : both_sides) {
    FEMixtureSurface& surface = surfaces[side];
    all[side].position = std::move(x[side]);
    all[side].scalar.resize(surface.Nodes(), effects.nodal_fields());
    for (int k = 0; k < effects.nodal_fields(); ++k) {
      const int dof = dofs.field(side, effects, k);
      in_parallel(surface.Nodes(),
                  [&](Index node) { all[side].scalar(node, k) = surface.Node(indexing::as_int(node)).get(dof); });
    }
  }
  return all;
}

void BoundContact::build(PerSide<SurfaceMesh> meshes, const Effects& effects) {
  core_ = std::make_unique<ContactInterface>(std::move(meshes), effects, core_settings(parameters_));
  numbers_ = surfaces().node_numbers();
  nodes_of_mesh_ = dofs_.fem().GetMesh().Nodes();
}

NumberedState BoundContact::numbered_state() const { return {numbers_, core_->state()}; }

void BoundContact::go_on_from(const NumberedState& before) {
  core_->restore(carried_over(before, numbered_state(), surfaces().positions()));
}

void BoundContact::rewind_to(const NumberedState& before) {
  PerSide<SurfaceMesh> meshes;
  for (const Side side : both_sides) meshes[side] = core_->mesh(side);
  build(std::move(meshes), Effects(core_->effects()));
  go_on_from(before);
}

PerSide<SurfaceFields> BoundContact::fields() const {
  PerSide<SurfaceFields> all = fields_of(dofs_, core_->effects());
  for (const Side side : both_sides) all[side].rigid = rigid_parts(surfaces()[side]);
  return all;
}

void BoundContact::project() {
  const TaskClock timed = core_->measurements().clock(Task::search);
  FEModel& fem = dofs_.fem();
  const bool is_any_free = dofs_.has_free_node(Side::primary) || dofs_.has_free_node(Side::secondary);
  const bool holds = !has_inertia(fem) &&
                     (dofs_.has_free_rigid_body(Side::primary) || dofs_.has_free_rigid_body(Side::secondary));
  // FEBio changes parameters and equations before it begins a step, and evaluates the model before it prepares the
  // contact for the step.
  for (std::size_t number = 0; number < core_->passes(); ++number) {
    ContactPass& pass = core_->pass(number);
    pass.measure_gaps_from(parameters_.gap.offset.value);
    pass.laws().between_rigid_bodies = !is_any_free;
    pass.laws().holds_rigid_body = holds;
  }
  const FESolver* solver = fem.GetCurrentStep()->GetFESolver();
  const bool keep_facets = parameters_.search.seg_up > 0 && solver->m_niter > parameters_.search.seg_up;
  core_->project(surfaces().positions(),
                 keep_facets ? ContactInterface::Search::same_facets : ContactInterface::Search::everywhere);
}

void BoundContact::prepare_step() {
  if (multiplier_layout(*core_).size() > 0) step_start_ = unknown_multipliers(*core_);
}

void BoundContact::note_beginning() { began_open_ = is_open(*core_); }

void BoundContact::report(const UndetectedPenetration& undetected) {
  const PerSide<std::string> names = surfaces().names();
  log_.line(penetration_line(log_.name(), names[Side::primary], names[Side::secondary], undetected));
}

std::string BoundContact::fail_step() {
  if (!core_->effects().traction) return "";
  NodalLaws& laws = core_->pass(0).laws();
  const bool bears_nothing = !laws.has_twin() && laws.multipliers.accepted_traction.isZero(0);
  if (began_open_ || bears_nothing) laws.close_overlapped = true;
  return began_open_ && !std::exchange(said_open_, true) ? open_contact_line(log_.name()) : "";
}

void BoundContact::set_multipliers(const std::vector<double>& total, const std::vector<double>& increment) {
  const Index count = multiplier_layout(*core_).size();
  if (count == 0) return;
  const auto of_contact = [&](const std::vector<double>& all) {
    return Eigen::Map<const VectorXd>(all.data() + dofs_.first_multiplier(), count);
  };
  set_unknown_multipliers(*core_, step_start_ + of_contact(total) + of_contact(increment));
}

void BoundContact::serialize(DumpStream& ar) {
  if (!ar.IsShallow()) {
    archive(ar, step_start_);
    Effects effects;
    PerSide<SurfaceMesh> meshes;
    if (ar.IsSaving()) {
      effects = core_->effects();
      for (const Side side : both_sides) meshes[side] = core_->mesh(side);
    }
    archive_effects(ar, effects);
    for (const Side side : both_sides) archive_mesh(ar, meshes[side]);
    if (!ar.IsSaving()) build(std::move(meshes), effects);
    forget_past(*core_);  // a continued run then gives the same results as this run
  }
  NumberedState numbered = numbered_state();
  const NodeNumbers present = numbered.nodes;
  for (IndexedVector<int>& numbers : numbered.nodes) archive(ar, static_cast<std::vector<int>&>(numbers));
  archive_state(ar, numbered.state);
  if (ar.IsSaving()) return;
  if (numbered.nodes == present) {
    core_->restore(std::move(numbered.state));
  } else {
    rewind_to(numbered);
  }
}
