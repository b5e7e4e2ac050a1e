#include "enforcement/held_linearisation.h"

#include "enforcement/load_difference.h"

namespace mixture_contact {
namespace {

/// What tractions are off by that an iteration predicts.
double doubt(const NodalLoads& predicted, const NodalLoads& now) {
  return (predicted.traction - now.traction).cwiseAbs().maxCoeff();
}

}  // namespace

void HeldLinearisation::replaced(LinearisationPoint& point) {
  ended();
  point_ = &point;
}

void HeldLinearisation::ended() {
  point_ = nullptr;
  change_ = {};
  last_doubt_ = 0;
  has_matrix_ = false;
  may_release_ = false;
}

void HeldLinearisation::has_matrix(bool may_release) {
  has_matrix_ = true;
  may_release_ = may_release && laws_.effects().nodal_fields() == 0;
}

void HeldLinearisation::follows(const NodalLoads& before) { change_ = AtPoints{change(before, point_->loads)}; }

bool HeldLinearisation::is_correctable() const {
  return has_matrix_ && point_->is_linearised() && method_.predicts() && point_->loads.friction.empty();
}

NodalLoads HeldLinearisation::true_loads(const FacingFields& fields) const {
  NodalLoads now = space_.averages(space_.gaps(), fields, point_->loads.status());
  method_.load(now);
  return now;
}

bool HeldLinearisation::may_take(const NodeFlags& status) const {
  if (!may_release_) return false;
  Index released = 0;
  for (Index node = 0; node < status.count(); ++node) {
    const bool is_linearised = !point_->nodes[node].empty();
    if (status[node] && !is_linearised) return false;
    if (!status[node] && is_linearised) ++released;
  }
  return released <= active_set_.options().most_released;
}

bool HeldLinearisation::serves(const FacingFields& fields) const {
  const NodalLoads predicted = method_.predicted_loads(*point_, fields);
  const NodalLoads now = true_loads(fields);
  const double off = doubt(predicted, now);
  const ActiveSetOptions& options = active_set_.options();
  const bool comes_nearer = last_doubt_ == 0 || off <= options.most_left * last_doubt_ ||
                            !differ(space_, laws_, predicted, now, options.solution_load, fields);
  const NodeFlags status = active_set_.updated(predicted, now, off);
  return comes_nearer && (status == predicted.in_contact || may_take(status));
}

bool HeldLinearisation::correct(const FacingFields& fields) {
  const NodalLoads predicted = method_.predicted_loads(*point_, fields);
  const NodalLoads now = true_loads(fields);
  point_->loads.gap += now.gap - predicted.gap;
  point_->loads.jump += now.jump - predicted.jump;
  last_doubt_ = doubt(predicted, now);
  if (may_release_) {
    const NodeFlags status = active_set_.updated(predicted, now, last_doubt_);
    const ContactStatus next = active_set_.next(predicted.in_contact, status, true);
    if (next.in_contact != predicted.in_contact) last_doubt_ = 0;
    point_->loads.in_contact = next.in_contact;
    point_->loads.flux_coupled = next.flux_coupled;
  }
  method_.load(point_->loads);
  const ByWorks corrected{change(predicted, method_.predicted_loads(*point_, fields))};
  change_ = corrected;
  return !corrected.loads.traction.isZero(0) || !corrected.loads.flux.isZero(0) || !released().empty();
}

IndexedVector<int> HeldLinearisation::released() const {
  IndexedVector<int> nodes;
  if (!may_release_) return nodes;
  for (Index node = 0; node < point_->nodes.count(); ++node) {
    if (!point_->loads.in_contact[node] && !point_->nodes[node].empty()) nodes.push_back(static_cast<int>(node));
  }
  return nodes;
}

bool HeldLinearisation::residual_change(const FacingFields& fields, double dt, const AddVector& add) const {
  if (const auto* at_points = std::get_if<AtPoints>(&change_)) {
    nodal_residual(space_, at_points->loads, fields, dt, add);
  } else if (const auto* by_works = std::get_if<ByWorks>(&change_)) {
    linear_residual(point_->nodes, by_works->loads, dt, add);
  }
  return !std::holds_alternative<std::monostate>(change_);
}

}  // namespace mixture_contact
