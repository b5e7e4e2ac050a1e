#include "active_set/active_set.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mixture_contact {
namespace {

/// The changed status, restricted for cycling nodes: only the first of the nodes that have changed more often than
/// `most` changes.
NodeFlags with_first_repeated(const NodeFlags& before, NodeFlags status, const IndexedVector<int>& changes, int most) {
  bool is_first = true;
  for (Index node = 0; node < status.count(); ++node) {
    if (status[node] == before[node] || changes[node] <= most) continue;
    if (!std::exchange(is_first, false)) status[node] = before[node];
  }
  return status;
}

double largest_of(const NodalLoads& loads) { return loads.traction.cwiseAbs().maxCoeff(); }

/// True if a sliding node is predicted to slide in the opposite direction.
bool slides_back(const NodalLoads& predicted, Index node) {
  return predicted.slips[node] && predicted.friction.trial.col(node).dot(predicted.friction.reference_of(node)) < 0;
}

/// The flags of nodes: `known` for those in contact in both states, `own` for the others.
NodeFlags with_known(NodeFlags own, const NodeFlags& known, const NodalLoads& last, const NodalLoads& now) {
  for (Index node = 0; node < own.count(); ++node) {
    if (now.in_contact[node] && last.in_contact[node]) own[node] = known[node];
  }
  return own;
}

/// The largest traction that does not change a status [MPa].
double negligible(const ActiveSetOptions& options, const NodalLaws& laws, double largest_traction,
                  double surface_size) {
  return std::max(options.negligible_traction * largest_traction, laws.traction_rounding(surface_size));
}

/// True if a node was in contact and not flux-coupled in the last accepted step.
bool was_at_edge(const Multipliers& last, Index node) {
  return last.accepted_traction[node] < 0 && !last.flux_coupled[node];
}

/// The friction status of nodes from their own loads alone.
FrictionStatus own_friction(const NodalLaws& laws, const NodalLoads& now) {
  FrictionStatus status{beyond_bound(laws, now), NodeFlags(laws.nodes(), false)};
  for (Index node = 0; node < laws.nodes(); ++node)
    status.rubs[node] = now.in_contact[node] && rubbing(laws, now, node) > 0;
  return status;
}

/// Per node, the half-width of the band around the friction bound in which trials do not change the status [MPa].
/// `changes`: ActiveSet's number of changes between stick and slip.
VectorXd friction_bands(const ActiveSetOptions& options, const NodalLaws& laws, const NodalLoads& predicted,
                        const IndexedVector<int>& changes) {
  double largest = 0;
  for (const double bound : predicted.friction.bound) largest = std::max(largest, bound);
  const double rounding = laws.traction_rounding(predicted.size);
  VectorXd bands(changes.count());
  for (Index node = 0; node < bands.size(); ++node) {
    const bool at_edge = changes[node] > options.most_status_changes;
    bands[node] = rounding + (at_edge ? options.edge_friction_band : options.friction_band) * largest;
  }
  return bands;
}

/// FrictionStatus::rubs of ActiveSet::updated_friction().
NodeFlags updated_rubs(const NodalLaws& laws, const NodalLoads& predicted, const VectorXd& bands) {
  NodeFlags rubs = predicted.rubs;
  for (Index node = 0; node < rubs.count(); ++node) {
    if (!predicted.in_contact[node]) continue;
    const double bound = rubbing(laws, predicted, node);
    if (std::abs(bound) > bands[node]) rubs[node] = bound > 0;
  }
  return rubs;
}

}  // namespace

NodeFlags ActiveSet::initial(const NodalLaws& laws, const NodalGaps& now) const {
  const double touch = options_.touch_fraction * now.size;
  NodeFlags status;
  for (Index node = 0; node < laws.nodes(); ++node) {
    const LawValue trial = laws.initial_trial(node, now.gap[node]);
    status.push_back(may_close(node) && now.faces(node) && laws.normal().begins(trial, touch));
  }
  return status;
}

bool may_predict(const NodalLaws& laws) {
  return laws.effects().nodal_fields() == 0 && !laws.may_meet_itself() && laws.normal().may_part();
}

NodeFlags ActiveSet::updated(const NodalLaws& laws, const NodalLoads& predicted, const NodalGaps& now,
                             double doubt) const {
  const double least = std::max(doubt, negligible(options_, laws, largest_of(predicted), now.size));
  NodeFlags status;
  for (Index node = 0; node < laws.nodes(); ++node) {
    const bool holds = predicted.sticks(node) || laws.normal().stays(predicted.traction[node], least);
    const bool stays = may_close(node) && now.faces(node) && holds;
    status.push_back(predicted.in_contact[node] ? stays : closes(laws, now, node, least));
  }
  return status;
}

NodeFlags ActiveSet::opening(const NodalLaws& laws, const VectorXd& tractions, const NodeFlags& opened,
                             double surface_size) const {
  double largest = 0;
  for (Index node = 0; node < opened.count(); ++node) {
    if (std::isfinite(tractions[node]) && !opened[node]) largest = std::max(largest, std::abs(tractions[node]));
  }
  const double least = negligible(options_, laws, largest, surface_size);
  NodeFlags opening = opened;
  for (Index node = 0; node < opened.count(); ++node) {
    const bool decides = std::abs(tractions[node]) > least;
    if (decides && changes_[node] <= options_.most_status_changes) opening[node] = tractions[node] > 0;
  }
  return opening;
}

ContactStatus ActiveSet::moved(const NodalLaws& laws, const NodalLoads& last, const NodalGaps& now) const {
  ContactStatus status{last.in_contact, last.flux_coupled};
  const double least = negligible(options_, laws, largest_of(last), now.size);
  for (Index node = 0; node < laws.nodes(); ++node) {
    if (!now.faces(node)) status.in_contact[node] = status.flux_coupled[node] = false;
    if (!status.in_contact[node] && closes(laws, now, node, least)) {
      status.in_contact[node] = status.flux_coupled[node] = true;
    }
  }
  return status;
}

ContactStatus ActiveSet::next(const NodalLaws& laws, const NodeFlags& before, NodeFlags updated, bool counts) {
  updated = with_first_repeated(before, std::move(updated), changes_, options_.most_joint_changes);
  if (counts && waits(laws, before, updated)) updated = before;
  ContactStatus status{updated, updated};
  if (counts) count(laws, before, updated);
  for (Index node = 0; node < updated.count(); ++node) {
    if (changes_[node] > options_.most_status_changes || cycles_alone(node)) status.flux_coupled[node] = false;
  }
  return status;
}

void ActiveSet::count(const NodalLaws& laws, const NodeFlags& before, const NodeFlags& status) {
  bool is_first_of_any = false;
  for (Index node = 0; node < status.count(); ++node) {
    if (status[node] == before[node]) continue;
    is_first_of_any = changes_[node]++ == 0 || is_first_of_any;
    ++repeated_changes_[node];
  }
  if (is_first_of_any) repeated_changes_.fill(laws.nodes(), 0);
}

bool ActiveSet::waits(const NodalLaws& laws, const NodeFlags& before, const NodeFlags& updated) {
  return laws.between_rigid_bodies && any(before) && !any(updated) && !std::exchange(has_waited_, true);
}

bool ActiveSet::cycles_alone(Index node) const { return repeated_changes_[node] >= options_.most_changes_alone; }

bool ActiveSet::reconsiders_edge(const NodalLaws& laws, const NodalLoads& solution) {
  bool any_new = false;
  for (Index node = 0; node < laws.nodes(); ++node) {
    const bool at_edge = solution.in_contact[node] && !solution.flux_coupled[node];
    any_new = any_new || (at_edge && !cycles_alone(node) && !was_at_edge(laws.multipliers, node));
  }
  if (!any_new || std::exchange(has_reconsidered_, true)) return false;
  changes_.fill(laws.nodes(), 0);
  repeated_changes_.fill(laws.nodes(), 0);
  return true;
}

void ActiveSet::start_counting(const NodalLaws& laws) {
  changes_.fill(laws.nodes(), 0);
  repeated_changes_.fill(laws.nodes(), 0);
  has_waited_ = has_reconsidered_ = false;
  slip_changes_.fill(laws.multipliers.slips.count(), 0);
}

FrictionStatus initial_friction(const NodalLaws& laws, const NodalLoads& now) {
  FrictionStatus status = own_friction(laws, now);
  const Multipliers& last = laws.multipliers;
  for (Index node = 0; node < laws.nodes(); ++node) {
    // A node without friction traction had no load between the solids while it slid, or was not in contact.
    const bool is_known = last.slips[node] || !last.friction.col(node).isZero(0);
    if (now.in_contact[node] && is_known) status.slips[node] = last.slips[node];
  }
  return status;
}

NodeFlags ActiveSet::updated_slips(const NodalLaws& laws, const NodalLoads& predicted, const VectorXd& bands) const {
  NodeFlags slips = predicted.slips;
  for (Index node = 0; node < slips.count(); ++node) {
    if (!predicted.in_contact[node]) continue;
    const bool pulled = !laws.normal().stays(predicted.traction[node], 0);
    const double bound = rubbing(laws, predicted, node);
    if (pulled || !(bound > 0)) {  // no load holds the node
      slips[node] = true;
      continue;
    }
    const Vector3d trial = predicted.friction.trial.col(node);
    const double excess = slips[node] && predicted.rubs[node]
                              ? slip_excess(trial, bound, predicted.friction.reference_of(node))
                              : trial.norm() - bound;
    if (std::abs(excess) > bands[node]) slips[node] = excess > 0 || turns_round(laws, predicted, node);
  }
  return slips;
}

FrictionStatus ActiveSet::updated_friction(const NodalLaws& laws, const NodalLoads& predicted) const {
  const VectorXd bands = friction_bands(options_, laws, predicted, slip_changes_);
  return {updated_slips(laws, predicted, bands), updated_rubs(laws, predicted, bands)};
}

bool ActiveSet::turns_round(const NodalLaws& laws, const NodalLoads& predicted, Index node) const {
  const bool first = slip_changes_[node] == 0;
  const double by_friction = 2 * laws.friction_penalty(node) / laws.penalties().stiffness[node];
  return first && slides_back(predicted, node) &&
         predicted.friction.trial.col(node).norm() > (1 + by_friction) * predicted.friction.bound[node];
}

FrictionStatus ActiveSet::next_friction(const NodalLaws& laws, const NodalLoads& predicted, const NodalLoads& now) {
  const FrictionStatus own = own_friction(laws, now);
  const NodeFlags before = with_known(own.slips, predicted.slips, predicted, now);
  const FrictionStatus updated = updated_friction(laws, predicted);
  NodeFlags slips = with_known(own.slips, updated.slips, predicted, now);
  slips = with_first_repeated(before, std::move(slips), slip_changes_, options_.most_joint_changes);
  for (Index node = 0; node < slips.count(); ++node) {
    if (slips[node] != before[node] || (slips[node] && slides_back(predicted, node))) ++slip_changes_[node];
  }
  return {std::move(slips), with_known(own.rubs, updated.rubs, predicted, now)};
}

FrictionStatus moved_friction(const NodalLaws& laws, const NodalLoads& last, const NodalLoads& now) {
  const FrictionStatus own = own_friction(laws, now);
  return {with_known(own.slips, last.slips, last, now), with_known(own.rubs, last.rubs, last, now)};
}

bool ActiveSet::closes(const NodalLaws& laws, const NodalGaps& now, Index node, double negligible) const {
  const double trial = laws.traction_trial(node, now.gap[node]).value;
  return may_close(node) && now.faces(node) && laws.normal().closes(trial, negligible);
}

}  // namespace mixture_contact
