#include "conditions/nodal_laws.h"

#include <algorithm>
#include <limits>

namespace mixture_contact {
namespace {

/// The fraction of a membrane that the fluxes at one surface's nodes cross: a half if the nodes of the other surface
/// have conditions as well.
double share_of_film(const SurfaceMesh& primary, const Settings& settings) {
  return settings.two_pass || primary.may_meet_itself() ? 0.5 : 1.0;
}

/// Copies the column of a node, unless one of the contacts has no such values.
void copy_node(Matrix3Xd& now, const Matrix3Xd& before, const std::pair<Index, Index>& node) {
  if (now.cols() > 0 && before.cols() > 0) now.col(node.first) = before.col(node.second);
}

void copy_node(NodeFlags& now, const NodeFlags& before, const std::pair<Index, Index>& node) {
  if (!now.empty() && !before.empty()) now[node.first] = before[node.second];
}

}  // namespace

NodalLaws::NodalLaws(const SurfaceMesh& primary, const SurfaceMesh& secondary, const Effects& effects,
                     const Settings& settings)
    : primary_(primary), secondary_(secondary), effects_(effects), settings_(settings) {
  multipliers.traction.setZero(primary.nodes);
  multipliers.flux.setZero(effects.scalar_fields(), primary.nodes);
  multipliers.flux_penalty_scale.setOnes(effects.scalar_fields());
  update_penalties();
  forget_steps();
}

void carry_over(Multipliers& now, const Multipliers& before, const CommonNodes& nodes) {
  if (before.flux.rows() != now.flux.rows()) return;
  now.traction_penalty_scale = before.traction_penalty_scale;
  now.flux_penalty_scale = before.flux_penalty_scale;
  now.friction_penalty_scale = before.friction_penalty_scale;
  for (const auto& node : nodes) {
    now.traction[node.first] = before.traction[node.second];
    now.flux.col(node.first) = before.flux.col(node.second);
    now.accepted_traction[node.first] = before.accepted_traction[node.second];
    copy_node(now.flux_coupled, before.flux_coupled, node);
    copy_node(now.friction, before.friction, node);
    copy_node(now.slips, before.slips, node);
  }
}

bool fits(const Multipliers& multipliers, Index nodes, const Effects& effects) {
  const Index fields = effects.scalar_fields();
  const Index with_friction = tangential_condition(effects.friction_kind).count() * nodes;
  const Index with_fluxes = fields > 0 ? nodes : 0;
  return multipliers.traction.size() == nodes && multipliers.accepted_traction.size() == nodes &&
         multipliers.flux.rows() == fields && multipliers.flux.cols() == nodes &&
         multipliers.flux_penalty_scale.size() == fields && multipliers.friction.cols() == with_friction &&
         multipliers.slips.count() == with_friction && multipliers.flux_coupled.count() == with_fluxes;
}

void NodalLaws::forget_steps() {
  multipliers.accepted_traction.setZero(nodes());
  if (effects_.scalar_fields() > 0) multipliers.flux_coupled = NodeFlags(nodes(), false);
  tangential_condition(effects_.friction_kind).forget(nodes(), multipliers);
}

void NodalLaws::update_penalties() {
  scalars_ = scalar_conditions(effects_, settings_.membrane, share_of_film(primary_, settings_));
  penalties_ = at_nodes(mixture_contact::penalties(primary_, secondary_, effects_, settings_), primary_);
  soft_ = settings_.traction.softens_fixed_gaps ? nodes_of_fixed_gap(primary_, secondary_) : NodeFlags();
  soften(penalties_, soft_);
}

LawValue NodalLaws::initial_trial(Index node, double gap) const {
  const double penalty = effects_.traction ? traction_penalty(node) : penalties_.stiffness[node];
  return augmented(multipliers.traction[node], penalty, gap);
}

void NodalLaws::load(NodalLoads& loads, bool with_penalty) const {
  loads.traction.setZero(nodes());
  loads.flux.setZero(effects_.scalar_fields(), nodes());
  for (Index node = 0; node < nodes(); ++node) {
    if (!loads.in_contact[node]) continue;
    if (effects_.traction) {
      const double penalty = with_penalty ? traction_penalty(node) : 0.0;
      const LawValue trial = augmented(multipliers.traction[node], penalty, loads.gap[node]);
      loads.traction[node] = NormalCondition::load(trial, loads.in_contact[node]).value;
    }
    for (int field = 0; field < effects_.scalar_fields(); ++field) {
      if (!loads.exchanges(field, node)) continue;
      loads.flux(field, node) = with_penalty ? scalar(field).value(loads, node, enforcing(field, node))
                                             : multipliers.flux(field, node);
    }
  }
  tangential().load(*this, loads);
}

void NodalLaws::augment(const NodalLoads& loads) {
  if (effects_.traction) multipliers.traction = admissible(normal(), loads.traction);
  for (Index node = 0; node < soft_.count(); ++node) {
    if (soft_[node]) multipliers.traction[node] = 0;
  }
  multipliers.flux = loads.flux;
  tangential().accept(loads, multipliers);
}

void NodalLaws::accept(const NodalLoads& loads) {
  if (effects_.scalar_fields() > 0) multipliers.flux_coupled = loads.flux_coupled;
  if (!effects_.traction) return;
  multipliers.accepted_traction = loads.traction;
  tangential().accept(loads, multipliers);
}

VectorXd stiffness_over_penalty(const NodalLaws& laws) {
  VectorXd part = VectorXd::Ones(laws.nodes());
  for (Index node = 0; node < laws.nodes() && !laws.between_rigid_bodies; ++node) {
    const double penalty = laws.traction_penalty(node);
    const double stiffness = laws.penalties().stiffness[node];
    if (penalty > stiffness) part[node] = stiffness / penalty;
  }
  return part;
}

void drop_new_fluxes(const Multipliers& multipliers, MatrixXd& flux) {
  for (Index node = 0; node < multipliers.flux_coupled.count(); ++node) {
    if (!multipliers.flux_coupled[node]) flux.col(node).setZero();
  }
}

VectorXd NodalLaws::within_accepted(const VectorXd& traction, double surface_size) const {
  const VectorXd accepted = multipliers.accepted_traction.cwiseAbs();
  const VectorXd most = accepted.array() + accepted_margin * accepted.maxCoeff() + traction_rounding(surface_size);
  return traction.cwiseMax(-most).cwiseMin(most);
}

double NodalLaws::traction_rounding(double surface_size) const {
  return multipliers.traction_penalty_scale * penalties_.traction.maxCoeff() * rounding_fraction * surface_size;
}

VectorXd NodalLaws::field_rounding(const FacingFields& fields, double surface_size) const {
  VectorXd rounding(effects_.scalar_fields());
  for (int field = 0; field < effects_.scalar_fields(); ++field) {
    const bool is_pressure = effects_.solvent && field == 0;
    const double stress = is_pressure ? penalties_.stiffness.maxCoeff() * surface_size : 0.0;
    rounding[field] = rounding_fraction * std::max({fields.primary.scalar.col(field).cwiseAbs().maxCoeff(),
                                                    fields.secondary.scalar.col(field).cwiseAbs().maxCoeff(), stress});
  }
  return rounding;
}

}  // namespace mixture_contact
