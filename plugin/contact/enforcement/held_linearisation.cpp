#include "enforcement/held_linearisation.h"

#include "enforcement/load_difference.h"
#include "mortar/gap_changes.h"

#include <algorithm>
#include <utility>

namespace mixture_contact {
namespace {

/// The error of the tractions that an iteration has predicted [MPa].
double error_of(const NodalLoads& predicted, const NodalLoads& now) {
  return (predicted.traction - now.traction).cwiseAbs().maxCoeff();
}

bool is_any_on(const RigidParts& rigid, const IndexedVector<int>& nodes) {
  return !rigid.body.empty() &&
         std::any_of(nodes.begin(), nodes.end(), [&](int node) { return rigid.body[node] >= 0; });
}

}  // namespace

void HeldLinearisation::replaced(LinearisationPoint& point, bool begins) {
  ended();
  point_ = &point;
  begins_ = begins;
}

void HeldLinearisation::ended() {
  point_ = nullptr;
  change_ = {};
  last_error_ = 0;
  has_matrix_ = false;
  has_loads_ = false;
}

void HeldLinearisation::has_matrix(bool has_loads) {
  has_matrix_ = point_ != nullptr;
  has_loads_ = has_loads && parts_.has_load_blocks() && parts_.laws.effects().nodal_fields() == 0;
  added_.fill(parts_.laws.nodes(), false);
}

void HeldLinearisation::follows(const NodalLoads& before) { change_ = AtPoints{change(before, point_->loads)}; }

bool HeldLinearisation::is_correctable() const {
  return has_matrix_ && point_->is_linearised() && parts_.method->is_linear();
}

NodalLoads HeldLinearisation::true_loads(const FacingFields& fields, ContactStatus status) const {
  NodalLoads now = parts_.space.averages(parts_.space.gaps(), fields, std::move(status));
  parts_.method->load(parts_.laws, now);
  return now;
}

double HeldLinearisation::doubt(const NodalLoads& predicted, const NodalLoads& now) const {
  double largest = 0;
  for (Index node = 0; node < parts_.laws.nodes(); ++node) {
    if (!predicted.in_contact[node]) continue;
    const double stiffness = std::min(parts_.laws.penalties().stiffness[node], parts_.laws.traction_penalty(node));
    largest = std::max(largest, stiffness * std::abs(predicted.gap[node] - now.gap[node]));
  }
  return largest;
}

bool HeldLinearisation::may_take(const NodeFlags& status, Index most) const {
  if (!has_loads_) return false;
  const auto around = parts_.space.facing().around(unknown_of(status));
  Index changed = 0;
  for (Index node = 0; node < status.count(); ++node) {
    const NodeLinearisation& linear = point_->nodes[node];
    const bool is_of_matrix = !linear.empty() && !added_[node];
    if (status[node] == is_of_matrix) continue;
    ++changed;
    if (is_of_rigid_bodies(linear.empty() ? parts_.space.node_patch(node, around[node]) : linear.patch)) return false;
  }
  return changed <= most;
}

NodeFlags HeldLinearisation::unknown_of(const NodeFlags& status) const {
  NodeFlags unknown;
  for (Index node = 0; node < status.count(); ++node) unknown.push_back(status[node] && point_->nodes[node].empty());
  return unknown;
}

bool HeldLinearisation::is_of_rigid_bodies(const Patch& patch) const {
  return is_any_on(point_->primary.rigid, patch.primary) || is_any_on(point_->secondary.rigid, patch.secondary);
}

bool HeldLinearisation::serves(const FacingFields& fields) const {
  const NodalLoads predicted = parts_.method->predicted_loads(parts_, *point_, fields);
  const NodalLoads now = true_loads(fields, point_->loads.status());
  const double error = error_of(predicted, now);
  const ActiveSetOptions& options = parts_.active_set.options();
  const bool comes_nearer = last_error_ == 0 || error <= options.most_left * last_error_ ||
                            !differ(parts_.space, parts_.laws, predicted, now, options.solution_load, fields);
  const NodeFlags status = parts_.active_set.updated(parts_.laws, predicted, now, doubt(predicted, now));
  return comes_nearer && (status == predicted.in_contact || may_take(status, options.most_changed_again));
}

bool HeldLinearisation::correct(const FacingFields& fields) {
  if (!is_correctable()) {
    keep();
    return false;
  }
  const NodalLoads predicted = parts_.method->predicted_loads(parts_, *point_, fields);
  const NodalLoads now = true_loads(fields, point_->loads.status());
  last_error_ = error_of(predicted, now);
  begins_ = false;
  const bool adds = has_loads_ && change_status(predicted, now, fields);
  point_->loads.gap += now.gap - (adds ? parts_.method->predicted_loads(parts_, *point_, fields) : predicted).gap;
  point_->loads.jump += now.jump - predicted.jump;
  parts_.method->load(parts_.laws, point_->loads);
  const ByWorks corrected{change(predicted, parts_.method->predicted_loads(parts_, *point_, fields))};
  change_ = corrected;
  return !corrected.loads.traction.isZero(0) || !corrected.loads.flux.isZero(0) || !released().empty() ||
         !added().empty();
}

bool HeldLinearisation::change_status(const NodalLoads& predicted, const NodalLoads& now, const FacingFields& fields) {
  const NodeFlags status = parts_.active_set.updated(parts_.laws, predicted, now, doubt(predicted, now));
  const ContactStatus next = parts_.active_set.next(parts_.laws, predicted.in_contact, status, true);
  if (next.in_contact != predicted.in_contact) last_error_ = 0;
  point_->loads.in_contact = next.in_contact;
  point_->loads.flux_coupled = next.flux_coupled;
  const NodeFlags unknown = unknown_of(next.in_contact);
  const bool adds = any(unknown);
  if (adds) linearise_more(unknown, fields);
  return adds;
}

void HeldLinearisation::linearise_more(const NodeFlags& nodes, const FacingFields& fields) {
  const NodalLoads there = true_loads(fields, {nodes, nodes, {}});
  IndexedVector<NodeLinearisation> linear = linearise(parts_.space, there, fields);
  for (Index node = 0; node < linear.count(); ++node) {
    if (!nodes[node]) continue;
    point_->nodes[node] = std::move(linear[node]);
    point_->loads.area[node] = there.area[node];  // the node may have faced nothing before
    added_[node] = true;
  }
}

bool HeldLinearisation::may_decide() const { return is_correctable() && has_loads_ && may_predict(parts_.laws); }

NodeFlags HeldLinearisation::find_nearing(const FacingPositions& displacements, const FacingFields& fields) {
  if (!may_decide() || begins_) return NodeFlags(parts_.laws.nodes(), false);
  NodeFlags apart;
  for (Index node = 0; node < parts_.laws.nodes(); ++node)
    apart.push_back(point_->nodes[node].empty() && parts_.space.gaps().faces(node));
  NodalGaps ahead = parts_.space.gaps();
  ahead.gap += gap_changes(parts_.space, apart, displacements);
  NodeFlags found = parts_.active_set.initial(parts_.laws, ahead);
  for (Index node = 0; node < parts_.laws.nodes(); ++node) found[node] = found[node] && apart[node];
  const auto around = parts_.space.facing().around(found);
  for (Index node = 0; node < parts_.laws.nodes(); ++node)
    found[node] = found[node] && !is_of_rigid_bodies(parts_.space.node_patch(node, around[node]));
  if (!any(found)) return found;
  linearise_more(found, fields);
  const NodalLoads predicted = parts_.method->predicted_loads(parts_, *point_, fields);
  for (Index node = 0; node < parts_.laws.nodes(); ++node) {
    if (found[node]) point_->loads.gap[node] += parts_.space.gaps().gap[node] - predicted.gap[node];
  }
  return found;
}

VectorXd HeldLinearisation::undecided(const FacingFields& fields) const {
  VectorXd tractions = unknown_values(parts_.laws.nodes());
  if (!may_decide()) return tractions;
  const NodalLoads now = parts_.method->predicted_loads(parts_, *point_, fields);
  for (Index node = 0; node < tractions.size(); ++node) {
    if (now.in_contact[node]) tractions[node] = now.traction[node];
  }
  for (const int node : nearing()) tractions[node] = parts_.laws.traction_trial(node, now.gap[node]).value;
  return tractions;
}

NodeFlags HeldLinearisation::opening(const VectorXd& tractions, const NodeFlags& opened) const {
  const NodeFlags found = parts_.active_set.opening(parts_.laws, tractions, opened, point_->loads.size);
  return may_take(status_without(found), parts_.active_set.options().most_changed) ? found : opened;
}

NodeFlags HeldLinearisation::status_without(const NodeFlags& open) const {
  NodeFlags status = point_->loads.in_contact;
  for (const int node : nearing()) status[node] = true;
  for (Index node = 0; node < status.count(); ++node) status[node] = status[node] && !open[node];
  return status;
}

void HeldLinearisation::open(const NodeFlags& nodes, const FacingFields& fields) {
  NodeFlags status = status_without(nodes);
  if (status == point_->loads.in_contact) return keep();
  const NodalLoads before = parts_.method->predicted_loads(parts_, *point_, fields);
  point_->loads.in_contact = std::move(status);
  point_->loads.flux_coupled = point_->loads.in_contact;
  parts_.method->load(parts_.laws, point_->loads);
  change_ = ByWorks{change(before, parts_.method->predicted_loads(parts_, *point_, fields))};
}

IndexedVector<int> HeldLinearisation::linearised(bool in_contact, bool is_added) const {
  IndexedVector<int> nodes;
  if (!has_loads_) return nodes;
  for (Index node = 0; node < point_->nodes.count(); ++node) {
    const bool is_one = !point_->nodes[node].empty() && point_->loads.in_contact[node] == in_contact;
    if (is_one && added_[node] == is_added) nodes.push_back(static_cast<int>(node));
  }
  return nodes;
}

void HeldLinearisation::add_loads(const IndexedVector<int>& nodes, double dt, const AddLoadBlock& add) const {
  for (const int node : nodes) {
    const NodeTangent tangent = parts_.method->node_tangent(parts_, node, point_->nodes[node], point_->loads, {}, dt);
    for (const LoadBlock& load : tangent.loads) add(load);
  }
}

void HeldLinearisation::residual_of(const AtPoints& change, const FacingFields& fields, double dt,
                                    const AddVector& add) const {
  // The works of nodes in contact are known, except those of friction and the fluxes of nodes that have opened.
  const bool has_works = point_->is_linearised() && parts_.method->is_linear() &&
                         parts_.laws.effects().nodal_fields() == 0;
  if (!has_works) return nodal_residual(parts_.space, change.loads, fields, dt, add);
  linear_residual(point_->nodes, change.loads, fields, dt, add);
  const NodeFlags others = unknown_of(change.loads.in_contact);
  if (!any(others)) return;
  NodalLoads rest = change.loads;
  rest.in_contact = others;
  for (Index node = 0; node < rest.traction.size(); ++node) {
    if (!others[node]) rest.traction[node] = 0;
  }
  nodal_residual(parts_.space, rest, fields, dt, add);
}

bool HeldLinearisation::residual_change(const FacingFields& fields, double dt, const AddVector& add) const {
  if (const auto* at_points = std::get_if<AtPoints>(&change_)) {
    residual_of(*at_points, fields, dt, add);
  } else if (const auto* by_works = std::get_if<ByWorks>(&change_)) {
    linear_residual(point_->nodes, by_works->loads, fields, dt, add);
  }
  return !std::holds_alternative<std::monostate>(change_);
}

}  // namespace mixture_contact
