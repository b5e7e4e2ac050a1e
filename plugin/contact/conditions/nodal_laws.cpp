#include "conditions/nodal_laws.h"

#include <Eigen/QR>

#include <algorithm>
#include <limits>

namespace mixture_contact {
namespace {

/// The fraction of a membrane that the fluxes at one surface's nodes cross: a half if the nodes of the other surface
/// have conditions as well.
double share_of_film(const SurfaceMesh& primary, const Settings& settings) {
  return settings.two_pass || primary.may_meet_itself() ? 0.5 : 1.0;
}

/// Sets the trials of friction, and bounds and status before their first decision.
void find_friction_limits(const NodalLaws& laws, NodalLoads& loads) {
  loads.friction.trial.setZero(3, laws.nodes());
  loads.friction.bound.setZero(laws.nodes());
  for (Index node = 0; node < laws.nodes(); ++node) {
    if (!loads.in_contact[node]) continue;
    loads.friction.trial.col(node) = laws.friction_trial(loads.friction, node).value;
    loads.friction.bound[node] = laws.friction_bound(loads, node).value;
  }
  if (loads.slips.empty()) loads.slips = laws.beyond_bound(loads);
}

/// Sets bound and friction traction of the nodes in contact by their status.
void load_friction(const NodalLaws& laws, NodalLoads& loads) {
  loads.friction.traction.setZero(3, laws.nodes());
  for (Index node = 0; node < laws.nodes(); ++node) {
    if (!loads.in_contact[node]) continue;
    loads.friction.bound[node] = laws.friction_bound(loads, node).value;
    loads.friction.traction.col(node) = friction_law(loads, node).value;
  }
}

/// Sets the reference of friction for an iteration (see NodalLaws::begin_friction()).
void refer_friction(const NodalLaws& laws, NodalLoads& loads, const NodalLoads* predicted) {
  NodalFriction& friction = loads.friction;
  friction.reference = friction.trial;
  friction.reference_bound.setZero(laws.nodes());
  friction.geometric.setZero(3, laws.nodes());
  for (Index node = 0; node < laws.nodes(); ++node) {
    if (!loads.in_contact[node]) continue;
    const bool known = predicted != nullptr && predicted->in_contact[node];
    const NodalLoads& from = known ? *predicted : loads;
    if (known) friction.reference.col(node) = predicted->friction.trial.col(node);
    const bool closes = predicted != nullptr && !known;
    friction.reference_bound[node] = loads.rubs[node] && !closes ? std::max(0.0, laws.rubbing(from, node)) : 0.0;
    const FrictionTrial trial = laws.friction_trial(loads.slips[node] ? friction : from.friction, node);
    friction.geometric.col(node) = trial.past;
    const double size = trial.value.norm();
    if (!loads.slips[node] && size > friction.reference_bound[node])
      friction.geometric.col(node) *= friction.reference_bound[node] / size;
  }
}

/// The friction multipliers whose trial equals the present friction without further slip.
Matrix3Xd friction_multipliers(const NodalFriction& friction) {
  Matrix3Xd lambda = Matrix3Xd::Zero(3, friction.slip.cols());
  for (Index node = 0; node < lambda.cols(); ++node) {
    if (friction.traction.col(node).isZero(0)) continue;
    const Vector3d n = friction.normal(node);
    const Eigen::Matrix3d to_present = friction.convection[node] - n * (n.transpose() * friction.convection[node]);
    lambda.col(node) = to_present.completeOrthogonalDecomposition().solve(friction.traction.col(node));
  }
  return lambda;
}

/// Copies the column of a node, unless one of the contacts has no such values.
void copy_node(Matrix3Xd& now, const Matrix3Xd& before, const std::pair<Index, Index>& node) {
  if (now.cols() > 0 && before.cols() > 0) now.col(node.first) = before.col(node.second);
}

void copy_node(NodeFlags& now, const NodeFlags& before, const std::pair<Index, Index>& node) {
  if (!now.empty() && !before.empty()) now[node.first] = before[node.second];
}

/// Accepts the present friction and slip status.
void take_friction(Multipliers& multipliers, const NodalLoads& loads) {
  if (loads.friction.empty()) return;
  multipliers.friction = friction_multipliers(loads.friction);
  multipliers.slips = loads.slips;
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
  const Index with_friction = effects.may_rub() ? nodes : 0;
  const Index with_fluxes = fields > 0 ? nodes : 0;
  return multipliers.traction.size() == nodes && multipliers.accepted_traction.size() == nodes &&
         multipliers.flux.rows() == fields && multipliers.flux.cols() == nodes &&
         multipliers.flux_penalty_scale.size() == fields && multipliers.friction.cols() == with_friction &&
         multipliers.slips.count() == with_friction && multipliers.flux_coupled.count() == with_fluxes;
}

void NodalLaws::forget_steps() {
  multipliers.accepted_traction.setZero(nodes());
  if (effects_.scalar_fields() > 0) multipliers.flux_coupled = NodeFlags(nodes(), false);
  if (!effects_.may_rub()) return;
  multipliers.friction.setZero(3, nodes());
  multipliers.slips = NodeFlags(nodes(), false);
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
  if (loads.friction.empty()) return;
  if (loads.friction.trial.size() == 0) find_friction_limits(*this, loads);  // else the iteration has predicted them
  load_friction(*this, loads);
}

FrictionTrial NodalLaws::friction_trial(const NodalFriction& friction, Index node) const {
  return carried_trial(friction, node,
                       multipliers.friction.col(node) - friction_penalty(node) * friction.slip.col(node));
}

FrictionTrial carried_trial(const NodalFriction& friction, Index node, const Vector3d& past) {
  const Vector3d n = friction.normal(node);
  const Vector3d present = friction.convection[node] * past;
  return {n, past, present, present - n * n.dot(present)};
}

ElasticSlip elastic_slip(const NodalLoads& loads, Index node) {
  const auto in_plane = [&] { return carried_trial(loads.friction, node, loads.friction.slip.col(node)).value; };
  return {loads.slips[node] ? 0.0 : in_plane().norm(), loads.friction.traction.col(node).norm()};
}

void NodalLaws::begin_friction(NodalLoads& loads, const DecideFriction& decide, const NodalLoads* predicted) const {
  if (loads.friction.empty()) return;
  FrictionStatus decided = decide(loads);
  loads.slips = std::move(decided.slips);
  loads.rubs = std::move(decided.rubs);
  refer_friction(*this, loads, predicted);
  load_friction(*this, loads);
}

FrictionBound NodalLaws::friction_bound(const NodalLoads& loads, Index node) const {
  const double pressure = loads.friction.pressure.size() > 0 ? loads.friction.pressure[node] : 0.0;
  const bool decided = !loads.rubs.empty();
  if (decided && !loads.rubs[node]) return {0, 0, 0};
  const auto law = decided ? linear_friction_bound : mixture_contact::friction_bound;
  return law(settings_.friction, loads.traction[node], pressure);
}

double NodalLaws::rubbing(const NodalLoads& loads, Index node) const {
  const double pressure = loads.friction.pressure.size() > 0 ? loads.friction.pressure[node] : 0.0;
  return linear_friction_bound(settings_.friction, loads.traction[node], pressure).value;
}

FrictionTraction friction_law(const NodalLoads& loads, Index node) {
  const Vector3d trial = loads.friction.trial.col(node);
  if (!loads.slips[node]) return stick(trial);
  return slip(trial, loads.friction.bound[node], loads.friction.reference_of(node),
              loads.friction.reference_bound_of(node));
}

NodeFlags NodalLaws::beyond_bound(const NodalLoads& loads) const {
  NodeFlags slips(nodes(), false);
  const double rounding = traction_rounding(loads.size);
  for (Index node = 0; node < nodes(); ++node) {
    const double excess = loads.friction.trial.col(node).norm() - loads.friction.bound[node];
    slips[node] = loads.in_contact[node] && excess > rounding;
  }
  return slips;
}

Matrix3Xd convected_friction(const Multipliers& multipliers, const NodalFriction& friction) {
  Matrix3Xd present = multipliers.friction;
  for (Index node = 0; node < present.cols(); ++node) present.col(node) = friction.convection[node] * present.col(node);
  return present;
}

void NodalLaws::augment(const NodalLoads& loads) {
  if (effects_.traction) multipliers.traction = admissible(normal(), loads.traction);
  for (Index node = 0; node < soft_.count(); ++node) {
    if (soft_[node]) multipliers.traction[node] = 0;
  }
  multipliers.flux = loads.flux;
  take_friction(multipliers, loads);
}

void NodalLaws::accept(const NodalLoads& loads) {
  if (effects_.scalar_fields() > 0) multipliers.flux_coupled = loads.flux_coupled;
  if (!effects_.traction) return;
  multipliers.accepted_traction = loads.traction;
  take_friction(multipliers, loads);
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
