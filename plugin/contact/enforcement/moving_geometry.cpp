#include "enforcement/moving_geometry.h"

#include "base/in_order.h"
#include "enforcement/both_parts.h"
#include "enforcement/load_difference.h"
#include "mortar/trial_variation.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace mixture_contact {
namespace {

/// Calls `add` with the flux blocks of all pairs. `units`: blocks for a time increment of 1.
void add_fluxes(const GeometricParts& units, double dt, const AddBlock& add) {
  const auto of_pair = [&](Index pair) {
    std::vector<TangentBlock> fluxes;
    if (!units[pair]) return fluxes;
    for (const FluxTangent& flux : units[pair]->fluxes) {
      fluxes.push_back(with_values(flux));
      fluxes.back().values *= dt;
    }
    return fluxes;
  };
  in_batches(units.count(), of_pair, [&](Index /*pair*/, const std::vector<TangentBlock>& fluxes) {
    for (const TangentBlock& flux : fluxes) add(flux);
  });
}

/// Calls `add` with the traction blocks of all pairs.
void add_tractions(const GeometricParts& units, const AddBlock& add) {
  for (const std::optional<GeometricTangent>& unit : units) {
    if (unit) add(with_values(unit->traction));
  }
}

/// True if a step begins with contact at all nodes around points that overlap. `any_in_contact`: whether any node is in
/// contact by its average gap. If both surfaces have conditions, contact on either surface is sufficient to hold the
/// bodies; `other_holds`: whether the other surface may hold them.
bool closes_overlapped(const NodalLaws& laws, bool any_in_contact, bool other_holds) {
  if (laws.close_overlapped) return !(laws.has_twin() && any_in_contact);
  return laws.holds_rigid_body && !any_in_contact && !other_holds;
}

/// True if two states of an iteration have the same status. `predicted`: whether an iteration predicted the loads
/// `before`; else their friction bounds are not decided.
bool have_same_status(const NodalLoads& before, const NodalLoads& now, bool predicted) {
  return before.in_contact == now.in_contact && before.flux_coupled == now.flux_coupled && before.slips == now.slips &&
         (!predicted || before.rubs == now.rubs);
}

/// Calls `use` with the patch of each node, which contains the facets of all pairs whose points are in the node's
/// averages.
void for_each_node_patch(const MortarSpace& space, const NodeFlags& in_contact,
                         const std::function<void(Index node, const Patch&)>& use) {
  const auto around = space.facing().around(in_contact);
  const auto absent = [&](Index node) { return around[node].empty() && !space.has_unknown_multipliers(); };
  const auto patch_of = [&](Index node) { return absent(node) ? Patch() : space.node_patch(node, around[node]); };
  in_order(around.count(), patch_of, [&](Index node, const Patch& patch) {
    if (!absent(node)) use(node, patch);
  });
}

}  // namespace

void MovingGeometry::update(const FacingPositions& x) {
  last_.take_over(geometric_);
  held_.moved();
  if (!point_) parts_.space.boundary_weights().reconsider();
  parts_.space.update_boundary_weights(x);
}

LinearisationPoint MovingGeometry::evaluated_at(const FacingFields& fields, NodalLoads averages,
                                                const DecideFriction& decide, const NodalLoads* predicted) const {
  LinearisationPoint point;
  point.loads = std::move(averages);
  parts_.method->load(parts_.laws, point.loads);
  parts_.laws.tangential().begin(parts_.laws, decide, predicted, point.loads);
  point.primary = fields.primary;
  point.secondary = fields.secondary;
  point.equation_weights = parts_.method->equation_weights(parts_, point.loads, fields.primary.position);
  if (!point.primary.rigid.body.empty() || !point.secondary.rigid.body.empty())
    point.beyond_part = stiffness_over_penalty(parts_.laws);
  return point;
}

void MovingGeometry::hold(LinearisationPoint point, const FacingFields& fields) {
  // The first iteration may reuse the last linearisation; later iterations linearise at their own state. Unknown
  // multipliers exclude reuse, because their rows include all nodes, and friction does, because slips are measured from
  // the start of each step.
  const bool begins = !point_ && parts_.method->predicts();
  const bool reuses = begins && parts_.method->is_linear();
  let_go();
  std::optional<PastLinearisation> past = last_.take();
  if (reuses) {
    geometric_ = linearise_both_parts(point, parts_.space, fields, std::move(past), same_to_linearisation(parts_.laws));
  } else {
    GeometricParts memory = past ? std::move(past->geometric.pairs) : GeometricParts();
    geometric_ = linearise_both_parts(point, parts_.space, fields, std::nullopt, 0, std::move(memory));
  }
  vary_trials(parts_.laws, point.loads, point.nodes);
  held_.replaced(point_.emplace(std::move(point)), begins);
}

const GeometricPart* MovingGeometry::geometric_at(const FacingPositions& x) const {
  if (!geometric_ || !point_) return nullptr;
  const bool is_there = point_->primary.position == x.primary && point_->secondary.position == x.secondary;
  return is_there ? &*geometric_ : nullptr;
}

NodeFlags MovingGeometry::updated_status(const NodalLoads& now, const NodalGaps& gaps) const {
  return point_ ? parts_.active_set.updated(parts_.laws, now, gaps) : parts_.active_set.initial(parts_.laws, gaps);
}

NodeFlags MovingGeometry::beginning_status(const NodalLoads& now, const NodalGaps& gaps, bool other_holds) const {
  NodeFlags status = updated_status(now, gaps);
  // After an augmentation, the trial of a node is about twice its load minus the previous multiplier, and does not show
  // whether the node is in contact. Nodes with a compressive multiplier therefore stay in contact until an iteration
  // has changed them.
  for (Index node = 0; augmented_ && node < status.count(); ++node) {
    status[node] = status[node] || (gaps.faces(node) && parts_.laws.multipliers.traction[node] < 0);
  }
  const bool begins = !point_ && !augmented_ && !parts_.active_set.is_restricted();
  if (!begins || !closes_overlapped(parts_.laws, any(status), other_holds)) return status;
  const bool is_free = parts_.laws.close_overlapped && !any(status);
  NodeFlags touching = overlapped_nodes(parts_.space);
  if (is_free && !any(touching)) touching = nearest_nodes(parts_.space);
  std::transform(status.begin(), status.end(), touching.begin(), status.begin(), std::logical_or<>());
  return status;
}

bool MovingGeometry::find_points(const FacingPositions& x) {
  const bool finds_more = parts_.space.keep_lost_points(x);
  if (finds_more && !point_) parts_.space.boundary_weights().reconsider();
  parts_.space.update_boundary_weights(x);
  return finds_more;
}

bool MovingGeometry::begin_iteration(const FacingFields& fields, bool other_holds) {
  const bool predicted = point_.has_value();
  const bool finds_more = find_points(positions(fields));
  const NodalLoads before = loads(fields);
  if (!predicted) parts_.active_set.start_counting(parts_.laws);
  const auto decide = [&](const NodalLoads& now) -> FrictionStatus {
    return predicted ? parts_.active_set.next_friction(parts_.laws, before, now) : initial_friction(parts_.laws, now);
  };
  NodalGaps gaps = parts_.space.gaps();
  ContactStatus status = parts_.active_set.next(parts_.laws, before.in_contact,
                                                beginning_status(before, gaps, other_holds), predicted);
  LinearisationPoint next = evaluated_at(fields, parts_.space.averages(std::move(gaps), fields, std::move(status)),
                                         decide, predicted ? &before : nullptr);
  set_geometric_loads(next, before);
  const bool changed = finds_more || !have_same_status(before, next.loads, predicted) ||
                       differ(parts_.space, parts_.laws, before, next.loads, parts_.active_set.options().same_load,
                              fields);
  const bool same_points = predicted && !finds_more && parts_.method->predicts();
  hold(std::move(next), fields);
  if (same_points) held_.follows(before);
  return changed;
}

void MovingGeometry::set_geometric_loads(LinearisationPoint& next, const NodalLoads& before) {
  const bool predicted = point_.has_value();
  if (std::exchange(augmented_, false)) {
    next.geometric_traction = parts_.laws.multipliers.traction;
    next.geometric_flux = parts_.laws.multipliers.flux;
    next.geometric_friction = convected_friction(parts_.laws.multipliers, next.loads.friction);
    return;
  }
  // If multipliers are unknowns, the predicted loads are the loads themselves.
  next.set_geometric(predicted && parts_.method->predicts() ? before : next.loads);
  if (predicted || !parts_.method->predicts()) return;
  drop_new_fluxes(parts_.laws.multipliers, next.geometric_flux);
  // Nodes that close around overlapping points may be in tension.
  const VectorXd traction = admissible(parts_.laws.normal(), next.geometric_traction);
  next.geometric_traction = parts_.laws.within_accepted(traction, parts_.space.facing().surface_size());
}

void MovingGeometry::hold_loads(const FacingFields& fields) {
  find_points(positions(fields));
  parts_.active_set.start_counting(parts_.laws);
  const auto decide = [&](const NodalLoads& now) { return initial_friction(parts_.laws, now); };
  geometric_.reset();
  last_ = {};
  point_ = evaluated_at(fields, initial_averages(fields), decide, nullptr);
  held_.ended();
}

void MovingGeometry::start_inactive(const FacingFields& fields) {
  NodeFlags open(parts_.space.nodes(), false);
  parts_.active_set.start_counting(parts_.laws);
  LinearisationPoint point = evaluated_at(
      fields, parts_.space.averages(parts_.space.gaps(), fields, {open, open, {}}),
      [&](const NodalLoads&) { return FrictionStatus{open, open}; }, nullptr);
  point.set_geometric(point.loads);
  hold(std::move(point), fields);
}

void MovingGeometry::linearise_at(const FacingFields& fields) {
  if (!point_) return;
  const auto decide = [&](const NodalLoads& now) -> FrictionStatus {
    return moved_friction(parts_.laws, point_->loads, now);
  };
  NodalGaps gaps = parts_.space.gaps();
  ContactStatus status = parts_.active_set.moved(parts_.laws, point_->loads, gaps);
  LinearisationPoint next = evaluated_at(fields, parts_.space.averages(std::move(gaps), fields, std::move(status)),
                                         decide, &point_->loads);
  next.set_geometric(point_->loads);
  hold(std::move(next), fields);
}

void MovingGeometry::let_go() {
  last_.take_over(geometric_);
  last_.take_over(point_);
  held_.ended();
}

void MovingGeometry::end_iterations() {
  let_go();
  parts_.space.boundary_weights().settle();
  parts_.space.change_facing().end_iterations();
}

void MovingGeometry::forget_past() {
  geometric_.reset();  // it remains if the surfaces have not moved since its computation
  last_ = {};
}

bool MovingGeometry::reconsiders_edge(const FacingFields& fields) {
  return parts_.laws.effects().scalar_fields() > 0 && parts_.active_set.reconsiders_edge(parts_.laws, loads(fields));
}

bool MovingGeometry::is_solution(const FacingFields& fields) const {
  if (!point_) return true;
  const NodalLoads predicted = parts_.method->predicted_loads(parts_, *point_, fields);
  NodalGaps gaps = parts_.space.gaps();
  if (updated_status(predicted, gaps) != point_->loads.in_contact) return false;
  if (!parts_.method->predicts()) return true;  // the loads are unknowns and need no test; gaps() tests the gaps
  if (parts_.active_set.updated_friction(parts_.laws, predicted).differs_from(predicted)) return false;
  NodalLoads now = parts_.space.averages(std::move(gaps), fields, point_->loads.status());
  parts_.method->load(parts_.laws, now);
  return !differ(parts_.space, parts_.laws, predicted, now, parts_.active_set.options().solution_load, fields);
}

NodalLoads MovingGeometry::loads(const FacingFields& fields) const {
  if (point_) return parts_.method->predicted_loads(parts_, *point_, fields);
  NodalLoads loads = initial_averages(fields);
  parts_.method->load(parts_.laws, loads);
  loads.traction = admissible(parts_.laws.normal(), loads.traction);
  return loads;
}

NodalLoads MovingGeometry::initial_averages(const FacingFields& fields) const {
  NodalGaps gaps = parts_.space.gaps();
  const NodeFlags status = parts_.active_set.initial(parts_.laws, gaps);
  return parts_.space.averages(std::move(gaps), fields, {status, status, {}});
}

NodeFlags MovingGeometry::flux_coupled() const {
  return point_ ? point_->loads.flux_coupled : parts_.active_set.initial(parts_.laws, parts_.space.gaps());
}

VectorXd MovingGeometry::equation_weights(const NodalLoads& loads, const Matrix3Xd& x1) const {
  return point_ ? point_->equation_weights : parts_.method->equation_weights(parts_, loads, x1);
}

void MovingGeometry::residual(const FacingFields& fields, double dt, const AddVector& add) const {
  const NodalLoads now = loads(fields);
  nodal_residual(parts_.space, now, fields, dt, add);
  parts_.method->equations(parts_, now, equation_weights(now, fields.primary.position), dt, add);
}

void MovingGeometry::tangent(const FacingFields& fields, double dt, const TangentParts& add) const {
  const NodalLoads now = loads(fields);
  IndexedVector<NodeLinearisation> present;
  const bool is_linearised = point_ && point_->is_linearised();
  if (!is_linearised) {
    present = linearise(parts_.space, now, fields);
    vary_trials(parts_.laws, now, present);
  }
  const VectorXd weights = equation_weights(now, fields.primary.position);
  node_tangents(parts_, is_linearised ? point_->nodes : present, now, weights, dt, add);
  if (const GeometricPart* held = geometric_at(positions(fields))) {
    if (add.rows) {
      for (const NodeRows& flux : held->fluxes) add.rows(flux, dt);
      add.rows(held->tractions, 1);
    } else {
      add_fluxes(held->pairs, dt, add.block);
      add_tractions(held->pairs, add.block);
    }
  } else {
    geometric_tangents(parts_.space, is_linearised ? geometric_loads(*point_) : now, fields, dt, add.block);
  }
}

void MovingGeometry::for_each_coupling(const Couplings& use) const {
  const auto use_around = [&](Index node, const Patch& patch) { use_node(parts_, node, patch, use); };
  const NodeFlags in_contact = point_ ? point_->loads.in_contact
                                      : parts_.active_set.initial(parts_.laws, parts_.space.gaps());
  if (geometric_ && point_) {  // the pairs are those with which the nodes were linearised
    for (Index node = 0; node < point_->nodes.count(); ++node) {
      if (!point_->nodes[node].empty()) use_around(node, point_->nodes[node].patch);
    }
  } else {
    for_each_node_patch(parts_.space, in_contact, use_around);
  }
  // The geometric part also couples the nodes of pairs that no nodal load couples.
  if (geometric_ && use.rows) {
    std::for_each(geometric_->fluxes.begin(), geometric_->fluxes.end(), use.rows);
    return use.rows(geometric_->tractions);
  }
  use_pairs(in_contact, use);
}

void MovingGeometry::use_pairs(const NodeFlags& in_contact, const Couplings& use) const {
  const bool all_pairs = parts_.space.has_unknown_multipliers() || takes_loads(parts_, use);
  for (const FacetPair& pair : parts_.space.facing().pairs()) {
    if (!parts_.space.facing().has_node_among(pair, in_contact)) continue;
    if (all_pairs || !parts_.space.is_averaged_over(pair, in_contact))
      use_effects(parts_.space, patch_of(parts_.space.facing(), pair), use.patch);
  }
}

std::size_t MovingGeometry::memory() const {
  const std::size_t geometric = geometric_ ? geometric_->memory() : 0;
  const std::size_t held = point_ ? point_->memory() + geometric + parts_.active_set.memory() : 0;
  return held + last_.memory();
}

}  // namespace mixture_contact
