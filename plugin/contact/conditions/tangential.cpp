#include "conditions/tangential.h"

#include "conditions/nodal_laws.h"

#include <Eigen/QR>

#include <algorithm>
#include <utility>

namespace mixture_contact {
namespace {

/// Sets the trials of friction, and bounds and status before their first decision.
void find_friction_limits(const NodalLaws& laws, NodalLoads& loads) {
  loads.friction.trial.setZero(3, laws.nodes());
  loads.friction.bound.setZero(laws.nodes());
  for (Index node = 0; node < laws.nodes(); ++node) {
    if (!loads.in_contact[node]) continue;
    loads.friction.trial.col(node) = friction_trial(laws, loads.friction, node).value;
    loads.friction.bound[node] = friction_bound(laws, loads, node).value;
  }
  if (loads.slips.empty()) loads.slips = beyond_bound(laws, loads);
}

/// Sets bound and friction traction of the nodes in contact by their status.
void load_friction(const NodalLaws& laws, NodalLoads& loads) {
  loads.friction.traction.setZero(3, laws.nodes());
  for (Index node = 0; node < laws.nodes(); ++node) {
    if (!loads.in_contact[node]) continue;
    loads.friction.bound[node] = friction_bound(laws, loads, node).value;
    loads.friction.traction.col(node) = friction_law(loads, node).value;
  }
}

/// Sets the reference of friction for an iteration (see TangentialCondition::begin()).
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
    friction.reference_bound[node] = loads.rubs[node] && !closes ? std::max(0.0, rubbing(laws, from, node)) : 0.0;
    const FrictionTrial trial = friction_trial(laws, loads.slips[node] ? friction : from.friction, node);
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

/// The excess pressure p~ - p* at a node [MPa].
double excess_pressure(const NodalFriction& friction, Index node) {
  return friction.pressure.size() > 0 ? friction.pressure[node] : 0.0;
}

}  // namespace

const TangentialCondition& tangential_condition(FrictionKind kind) {
  static const TangentialCondition frictionless;
  static const Coulomb coulomb;
  return by_friction<const TangentialCondition&>(
      kind, []() -> const TangentialCondition& { return frictionless; },
      []() -> const TangentialCondition& { return coulomb; });
}

void Coulomb::forget(Index nodes, Multipliers& multipliers) const {
  multipliers.friction.setZero(3, nodes);
  multipliers.slips = NodeFlags(nodes, false);
}

void Coulomb::load(const NodalLaws& laws, NodalLoads& loads) const {
  if (loads.friction.trial.size() == 0) find_friction_limits(laws, loads);  // else the iteration has predicted them
  load_friction(laws, loads);
}

void Coulomb::begin(const NodalLaws& laws, const DecideFriction& decide, const NodalLoads* predicted,
                    NodalLoads& loads) const {
  FrictionStatus decided = decide(loads);
  loads.slips = std::move(decided.slips);
  loads.rubs = std::move(decided.rubs);
  refer_friction(laws, loads, predicted);
  load_friction(laws, loads);
}

void Coulomb::accept(const NodalLoads& loads, Multipliers& multipliers) const {
  multipliers.friction = friction_multipliers(loads.friction);
  multipliers.slips = loads.slips;
}

FrictionTrial friction_trial(const NodalLaws& laws, const NodalFriction& friction, Index node) {
  return carried_trial(friction, node,
                       laws.multipliers.friction.col(node) - laws.friction_penalty(node) * friction.slip.col(node));
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

FrictionBound friction_bound(const NodalLaws& laws, const NodalLoads& loads, Index node) {
  const bool decided = !loads.rubs.empty();
  if (decided && !loads.rubs[node]) return {0, 0, 0};
  const double pressure = excess_pressure(loads.friction, node);
  return decided ? linear_friction_bound(laws.friction(), loads.traction[node], pressure)
                 : friction_bound(laws.friction(), loads.traction[node], pressure);
}

double rubbing(const NodalLaws& laws, const NodalLoads& loads, Index node) {
  return linear_friction_bound(laws.friction(), loads.traction[node], excess_pressure(loads.friction, node)).value;
}

FrictionTraction friction_law(const NodalLoads& loads, Index node) {
  const Vector3d trial = loads.friction.trial.col(node);
  if (!loads.slips[node]) return stick(trial);
  return slip(trial, loads.friction.bound[node], loads.friction.reference_of(node),
              loads.friction.reference_bound_of(node));
}

NodeFlags beyond_bound(const NodalLaws& laws, const NodalLoads& loads) {
  NodeFlags slips(laws.nodes(), false);
  const double rounding = laws.traction_rounding(loads.size);
  for (Index node = 0; node < laws.nodes(); ++node) {
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

}  // namespace mixture_contact
