/// Which nodes are in contact, and what holds during a Newton iteration: a part of ContactPass.
#include "base/parallel.h"
#include "interface/pass.h"

#include <algorithm>
#include <utility>

namespace mixture_contact {
namespace {

/// Loads below this part of the largest one do not decide about contact: rounding, and what Newton leaves.
constexpr double status_tolerance = 1e-6;
/// Loads that differ by less than this part of the largest one are the same; and are near enough for a solution.
constexpr double load_rounding = 1e-9;
constexpr double load_tolerance = 1e-2;

/// Whether two arrays of loads (fields, nodes) differ by more than a part of a field's largest entry, and by more than
/// `rounding` of the field.
bool differs(const MatrixXd& one, const MatrixXd& other, double part, const VectorXd& rounding) {
  for (Index field = 0; field < one.rows(); ++field) {
    const double size = std::max(one.row(field).cwiseAbs().maxCoeff(), other.row(field).cwiseAbs().maxCoeff());
    if (!((one.row(field) - other.row(field)).cwiseAbs().maxCoeff() <= part * size + rounding[field])) return true;
  }
  return false;
}

SurfaceFields change(const SurfaceFields& from, const SurfaceFields& to) {
  return {to.position - from.position, to.scalar - from.scalar};
}

/// Displacements of a patch's nodes in the order of patch.of_displacements(), given those of both surfaces.
VectorXd displacements_at(const Patch& patch, const SurfaceFields& primary, const SurfaceFields& secondary) {
  const LocalLayout layout = patch.of_displacements().layout();
  VectorXd values(layout.size());
  for (Index n = 0; n < layout.nodes(); ++n) {
    const bool first = n < layout.primary_nodes();
    values.segment<3>(layout.displacement(n, 0)) = first ? primary.position.col(patch.node(n))
                                                         : secondary.position.col(patch.node(n));
  }
  return values;
}

/// The status before with the first of the changes alone.
std::vector<bool> with_first_change(const std::vector<bool>& before, const std::vector<bool>& status) {
  std::vector<bool> next = before;
  const auto [was, is] = std::mismatch(before.begin(), before.end(), status.begin());
  if (was != before.end()) next[static_cast<std::size_t>(was - before.begin())] = *is;
  return next;
}

}  // namespace

bool ContactPass::seen(const NodalLoads& loads, Index node) { return loads.area[node] > 0; }

std::vector<bool> ContactPass::natural_status(const Matrix3Xd& x1, const Matrix3Xd& x2) const {
  NodalLoads loads;
  average_gaps(x1, x2, loads);
  std::vector<bool> status;
  for (Index node = 0; node < primary_.nodes; ++node) {
    // Surfaces that exchange no traction touch whatever the penalty.
    const double penalty = effects_.traction ? traction_penalty(node) : penalties_.stiffness[node];
    const LawValue law = normal_traction(multipliers.traction[node], penalty, loads.gap[node], touch_);
    status.push_back(may_close(node) && seen(loads, node) && law.derivative > 0);
  }
  return status;
}

std::vector<bool> ContactPass::next_status(const SurfaceFields& primary, const SurfaceFields& secondary) const {
  if (!held_) return natural_status(primary.position, secondary.position);
  const NodalLoads predicted = predicted_loads(*held_, primary, secondary);
  NodalLoads now;
  average_gaps(primary.position, secondary.position, now);
  const double negligible = negligible_traction(predicted);
  std::vector<bool> status;
  for (Index node = 0; node < primary_.nodes; ++node) {
    const bool was = predicted.in_contact[static_cast<std::size_t>(node)];
    const bool stays = may_close(node) && seen(now, node) && predicted.traction[node] <= negligible;
    status.push_back(was ? stays : closes(now, node, negligible));
  }
  return status;
}

double ContactPass::negligible_traction(const NodalLoads& loads) const {
  return std::max(status_tolerance * loads.traction.cwiseAbs().maxCoeff(), traction_rounding());
}

bool ContactPass::closes(const NodalLoads& now, Index node, double negligible) const {
  const double overlap_load = multipliers.traction[node] + traction_penalty(node) * now.gap[node];
  return may_close(node) && seen(now, node) && overlap_load < -negligible;
}

std::vector<bool> ContactPass::sealed_nodes(const Matrix3Xd& x1, const Matrix3Xd& x2) const {
  if (frozen_) return frozen_->geometry.sealed;
  return held_ ? held_->loads.sealed : natural_status(x1, x2);
}

NodalLoads ContactPass::predicted_loads(const Held& held, const SurfaceFields& primary,
                                        const SurfaceFields& secondary) const {
  if (has_unknown_multipliers()) {
    NodalLoads loads = averages(primary, secondary, held.loads.in_contact, held.loads.sealed);
    apply_laws(loads);
    return loads;
  }
  NodalLoads loads = held.loads;
  const SurfaceFields first = change(held.primary, primary);
  const SurfaceFields second = change(held.secondary, secondary);
  in_parallel(held.nodes.size(), [&](std::size_t index) {
    const NodeLinearisation& linear = held.nodes[index];
    if (linear.empty()) return;
    const auto node = static_cast<Index>(index);
    const VectorXd moved = displacements_at(linear.patch, first, second);
    loads.gap[node] += linear.gap_variation.dot(moved);
    for (std::size_t k = 0; k < linear.jumps.size(); ++k) {
      const int field = linear.patch.fields[k];
      loads.jump(field, node) += linear.jumps[k].drift.dot(moved) + jump_of(linear, k, first, second);
    }
  });
  apply_laws(loads);
  return loads;
}

ContactPass::Held ContactPass::held_at(const SurfaceFields& primary, const SurfaceFields& secondary,
                                       std::vector<bool> in_contact, std::vector<bool> sealed) const {
  Held held;
  held.loads = averages(primary, secondary, std::move(in_contact), std::move(sealed));
  apply_laws(held.loads);
  held.nodes = linearise(held.loads, primary, secondary);
  held.primary = primary;
  held.secondary = secondary;
  if (has_unknown_multipliers()) held.multiplier_weights = multiplier_weights(held.loads, primary.position);
  return held;
}

bool ContactPass::begin_iteration(const SurfaceFields& primary, const SurfaceFields& secondary) {
  if (frozen_) return false;  // the laws are linear, and no status changes
  const bool finds_more = points_->begin_iteration();
  if (finds_more) project(primary.position, secondary.position, radius_);
  const bool predicted = held_.has_value();
  find_bearing_nodes(primary.position, secondary.position);
  const NodalLoads before = nodal_loads(primary, secondary);
  std::vector<bool> status = next_status(primary, secondary);
  std::vector<int> changes = held_ ? held_->changes : std::vector<int>(status.size(), 0);
  const bool in_circles = !changes.empty() && *std::max_element(changes.begin(), changes.end()) > most_joint_changes;
  if (in_circles) status = with_first_change(before.in_contact, status);
  std::vector<bool> sealed = status;
  for (std::size_t node = 0; node < status.size(); ++node) {
    if (predicted && status[node] != before.in_contact[node]) ++changes[node];
    if (changes[node] > most_status_changes) sealed[node] = false;
  }
  Held next = held_at(primary, secondary, status, std::move(sealed));
  next.changes = std::move(changes);
  // Unknown multipliers are what an iteration predicts: there is nothing to tell apart.
  const NodalLoads& geometric = predicted && !has_unknown_multipliers() ? before : next.loads;
  const bool augmented = std::exchange(augmented_, false);
  next.geometric_traction = augmented ? multipliers.traction : geometric.traction;
  next.geometric_flux = augmented ? multipliers.flux : geometric.flux;
  const bool changed = finds_more || before.in_contact != next.loads.in_contact || before.sealed != next.loads.sealed ||
                       loads_differ(before, next.loads, load_rounding, primary, secondary);
  held_ = std::move(next);
  return changed;
}

void ContactPass::begin_open(const SurfaceFields& primary, const SurfaceFields& secondary) {
  const std::vector<bool> open(static_cast<std::size_t>(primary_.nodes), false);
  Held held = held_at(primary, secondary, open, open);
  held.changes.assign(open.size(), 0);
  held.geometric_traction = held.loads.traction;
  held.geometric_flux = held.loads.flux;
  held_ = std::move(held);
}

void ContactPass::augment(const SurfaceFields& primary, const SurfaceFields& secondary) {
  const NodalLoads loads = nodal_loads(primary, secondary);
  if (effects_.traction) multipliers.traction = loads.traction.cwiseMin(0.0);
  multipliers.flux = loads.flux;
  augmented_ = true;
}

void ContactPass::move_iteration(const SurfaceFields& primary, const SurfaceFields& secondary) {
  if (!held_) return;
  std::vector<bool> in_contact = held_->loads.in_contact;
  std::vector<bool> sealed = held_->loads.sealed;
  NodalLoads now;
  average_gaps(primary.position, secondary.position, now);
  const double negligible = negligible_traction(held_->loads);
  for (Index node = 0; node < primary_.nodes; ++node) {
    const auto index = static_cast<std::size_t>(node);
    if (!seen(now, node)) in_contact[index] = sealed[index] = false;
    if (!in_contact[index] && closes(now, node, negligible)) in_contact[index] = sealed[index] = true;
  }
  Held next = held_at(primary, secondary, std::move(in_contact), std::move(sealed));
  next.changes = held_->changes;
  next.geometric_traction = held_->loads.traction;
  next.geometric_flux = held_->loads.flux;
  held_ = std::move(next);
}

bool ContactPass::is_solution(const SurfaceFields& primary, const SurfaceFields& secondary) const {
  if (!held_) return true;
  if (next_status(primary, secondary) != held_->loads.in_contact) return false;
  if (has_unknown_multipliers()) return true;  // predicted loads are the loads; what is left of gaps, gaps() tells
  const NodalLoads predicted = predicted_loads(*held_, primary, secondary);
  NodalLoads now = averages(primary, secondary, held_->loads.in_contact, held_->loads.sealed);
  apply_laws(now);
  return !loads_differ(predicted, now, load_tolerance, primary, secondary);
}

double ContactPass::traction_rounding() const {
  return multipliers.traction_growth * penalties_.traction.maxCoeff() * rounding_fraction / touch_fraction * touch_;
}

VectorXd ContactPass::field_rounding(const SurfaceFields& primary, const SurfaceFields& secondary) const {
  VectorXd rounding(effects_.scalar_fields());
  for (int field = 0; field < effects_.scalar_fields(); ++field) {
    const bool is_pressure = effects_.solvent && field == 0;
    const double stress = is_pressure ? penalties_.stiffness.maxCoeff() / touch_fraction * touch_ : 0.0;
    rounding[field] = rounding_fraction * std::max({primary.scalar.col(field).cwiseAbs().maxCoeff(),
                                                    secondary.scalar.col(field).cwiseAbs().maxCoeff(), stress});
  }
  return rounding;
}

bool ContactPass::loads_differ(const NodalLoads& one, const NodalLoads& other, double part,
                               const SurfaceFields& primary, const SurfaceFields& secondary) const {
  VectorXd flux_rounding = field_rounding(primary, secondary);
  for (int field = 0; field < effects_.scalar_fields(); ++field) {
    flux_rounding[field] *= multipliers.flux_growth[field] * penalties_.flux.row(field).maxCoeff();
  }
  return differs(one.traction.transpose(), other.traction.transpose(), part,
                 VectorXd::Constant(1, traction_rounding())) ||
         differs(one.flux, other.flux, part, flux_rounding);
}

}  // namespace mixture_contact
