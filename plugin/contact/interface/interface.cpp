#include "interface/interface.h"

#include "base/parallel.h"
#include "enforcement/moving_geometry.h"

#include <algorithm>
#include <stdexcept>

namespace mixture_contact {
namespace {

GapReport measure_gaps(const ContactPass& pass, const FacingFields& fields) {
  return measure_gaps(pass.laws(), pass.nodal_loads(fields), fields);
}

void keep_worst(FieldGap& worst, const FieldGap& gap) {
  worst.relative = larger(worst.relative, gap.relative);
  worst.largest = larger(worst.largest, gap.largest);
}

void keep_worst(IndexedVector<FieldGap>& worst, const IndexedVector<FieldGap>& gaps) {
  for (Index k = 0; k < worst.count(); ++k) keep_worst(worst[k], gaps[k]);
}

Memory memory_of(const std::vector<SidedPass>& passes) {
  Memory now;
  for (const SidedPass& pass : passes) {
    now.points += indexing::entries(point_count(pass.integral->space().facing()));
    now.bytes += pass.integral->memory();
  }
  return now;
}

/// The largest distance by which two surfaces may have moved relative to each other [length].
double largest_motion(const PerSide<Matrix3Xd>& from, const PerSide<Matrix3Xd>& to) {
  const Vector3d common = (to[Side::secondary] - from[Side::secondary]).rowwise().mean();
  const auto of_side = [&](Side side) {
    return ((to[side] - from[side]).colwise() - common).colwise().norm().maxCoeff();
  };
  return of_side(Side::primary) + of_side(Side::secondary);
}

/// True if accepted states extend a given search radius (see reach_in_step()). The radius of self-contact is fixed: the
/// next fold may be within the motion of a step.
bool extends_radius(const Settings& settings, const PerSide<SurfaceMesh>& mesh) {
  return settings.search.radius > 0 && !mesh[Side::primary].may_meet_itself();
}

/// An accepted state at these positions.
AcceptedState accepted_state(const std::vector<SidedPass>& passes, PerSide<Matrix3Xd> position) {
  double overlap = 0;
  for (const SidedPass& pass : passes) {
    const FacingPairs& facing = pass.integral->space().facing();
    const NodeFlags in_contact = pass.integral->flux_coupled();
    overlap = std::max(overlap, deepest_overlap(facing, seen_from(pass.side, position), in_contact));
  }
  return {std::move(position), overlap};
}

/// The search distances in a step. Overlaps may exceed a given search radius by the motion of the step, because an
/// iteration may move a body too far. They may also exceed it as far as those of the last accepted state: a soft
/// penalty may need them, and points that a search lost would pass through the other body.
Reach reach_in_step(const Settings& settings, const AcceptedState& accepted, const PerSide<Matrix3Xd>& position) {
  Reach reach = reach_of(settings, seen_from(Side::primary, position));
  if (accepted.position[Side::primary].cols() == 0) return reach;
  reach.beyond = std::max(0.0, accepted.overlap - reach.distance) + largest_motion(accepted.position, position);
  return reach;
}

void find_points(SidedPass& pass, const PerSide<Matrix3Xd>& position, const Reach& reach) {
  pass.reach = reach;
  pass.integral->project(seen_from(pass.side, position), reach);
}

SidedPass make_pass(Side side, const PerSide<SurfaceMesh>& mesh, const Effects& effects, const Settings& settings) {
  SidedPass pass;
  pass.side = side;
  pass.integral = std::make_unique<ContactPass>(mesh[side], mesh[other(side)], effects, settings);
  return pass;
}

}  // namespace

ContactInterface::ContactInterface(PerSide<SurfaceMesh> mesh, Effects effects, Settings settings)
    : mesh_(std::move(mesh)),
      effects_(std::move(effects)),
      settings_(std::move(settings)),
      check_{settings_of_check(settings_), NodeFlags(mesh_[Side::secondary].nodes, false), {}},
      measurements_(effects_.scalar_fields()) {
  if (settings_.two_pass && settings_.enforcement == Enforcement::lagrange_multipliers) {
    throw std::invalid_argument(
        "unknown multipliers on both surfaces have twice as many conditions as the surfaces can meet: set one pass, or "
        "AUGLAG");
  }
  passes_.push_back(make_pass(Side::primary, mesh_, effects_, settings_));
  if (settings_.two_pass) passes_.push_back(make_pass(Side::secondary, mesh_, effects_, settings_));
}

void ContactInterface::project(const PerSide<Matrix3Xd>& position, Search search) {
  const TaskClock timed = measurements_.clock(Task::search);
  const auto same = [&](Side side) {
    return position_[side].cols() == position[side].cols() && position_[side] == position[side];
  };
  // Nodes that join() has freed may have no facets from the last search.
  const bool search_all = search == Search::everywhere || position_[Side::primary].cols() == 0;
  if (same(Side::primary) && same(Side::secondary) && (searched_ || !search_all)) return;
  position_ = position;
  searched_ = search_all;
  const bool is_start = accepted_.position[Side::primary].cols() == 0;
  if (is_start && extends_radius(settings_, mesh_)) accepted_.position = position_;
  for (SidedPass& pass : passes_) {
    pass.hits.reset();
    pass.integral->slips().begin_at(pass.integral->space().facing(), seen_from(pass.side, position_));
    if (search_all) {
      find_points(pass, position_, reach_in_step(settings_, accepted_, position_));
    } else {
      pass.integral->project_on_same_facets(seen_from(pass.side, position_));
    }
  }
}

void ContactInterface::accept_step(const PerSide<SurfaceFields>& fields) {
  const TaskClock timed = measurements_.clock(Task::augmentation);
  bool changes_averages = false;
  for (SidedPass& pass : passes_) {
    if (pass.faced) {
      const NodeFlags& in_contact = pass.integral->flux_coupled();
      pass.faced_before = facing_contact(pass, facing_nodes(pass, mesh_, position_, in_contact, settings_));
    }
    changes_averages = pass.integral->accept_step(seen_from(pass.side, fields)) || changes_averages;
    pass.integral->laws().close_overlapped = false;
  }
  if (extends_radius(settings_, mesh_))
    accepted_ = accepted_state(passes_, {{fields[Side::primary].position, fields[Side::secondary].position}});
  if (changes_averages) end_iterations();
}

void ContactInterface::exchange_traction(bool traction) {
  effects_.traction = traction;
  for (SidedPass& pass : passes_) {
    pass.faced.reset();
    pass.integral->forget();
  }
  for (Matrix3Xd& position : position_) position.resize(3, 0);
}

bool ContactInterface::begin_iteration(const PerSide<SurfaceFields>& fields) {
  TaskClock timed = measurements_.clock(Task::stiffness);
  bool changed = false;
  // The first of two surfaces with conditions leaves bodies that no node holds to the second one.
  bool other_holds = pass(0).laws().has_twin();
  for_each_moving(*this, [&](Side side, MovingGeometry& moving) {
    changed = moving.begin_iteration(seen_from(side, fields), other_holds) || changed;
    other_holds = any(moving.flux_coupled());
  });
  for (const SidedPass& pass : passes_) timed.take(pass.integral->space().effect_times(), thread_count());
  measurements_.note(memory_of(passes_));
  return changed;
}

void ContactInterface::linearise_at(const PerSide<SurfaceFields>& fields) const {
  for_each_moving(*this, [&](Side side, MovingGeometry& moving) { moving.linearise_at(seen_from(side, fields)); });
}

bool ContactInterface::is_solution(const PerSide<SurfaceFields>& fields) const {
  const TaskClock timed = measurements_.clock(Task::augmentation);
  bool agrees = true;
  for_each_moving(*this, [&](Side side, const MovingGeometry& moving) {
    agrees = agrees && moving.is_solution(seen_from(side, fields));
  });
  return agrees && faces_as_held(*this) &&
         (settings_.enforcement != Enforcement::lagrange_multipliers ||
          meets(gaps(fields), settings_.tolerances, effects_));
}

void ContactInterface::residual(const PerSide<SurfaceFields>& fields, double dt, const AddResidual& add) const {
  TaskClock timed = measurements_.clock(Task::residual);
  for (const SidedPass& pass : passes_) {
    pass.integral->geometry().residual(
        seen_from(pass.side, fields), dt,
        [&](const Patch& patch, const VectorXd& values) { timed.in_host([&] { add({pass.side, patch}, values); }); });
  }
}

void ContactInterface::tangent(const PerSide<SurfaceFields>& fields, double dt, const AddTangent& add,
                               const AddLoadTangent& add_load, const AddRows& add_rows) const {
  TaskClock timed = measurements_.clock(Task::stiffness);
  for (const SidedPass& pass : passes_) {
    TangentParts parts;
    parts.block = [&](const TangentBlock& block) {
      timed.in_host(block.rows, [&] { add({pass.side, block.rows}, {pass.side, block.columns}, block.values); });
    };
    if (add_load)
      parts.load = [&](const LoadBlock& load) { timed.in_host(load.rows, [&] { add_load(pass.side, load); }); };
    if (add_rows)
      parts.rows = [&](const IndexedVector<TangentBlock>& rows, double factor) {
        if (!rows.empty()) timed.in_host(rows.front().rows, [&] { add_rows(pass.side, rows, factor); });
      };
    pass.integral->geometry().tangent(seen_from(pass.side, fields), dt, parts);
    timed.take(pass.integral->space().effect_times(), thread_count());
  }
}

void ContactInterface::for_each_coupling(const UseLocation& use, const UseLoadPlace& use_load,
                                         const UseRows& use_rows) const {
  TaskClock timed = measurements_.clock(Task::stiffness);
  for (const SidedPass& pass : passes_) {
    Couplings couplings;
    couplings.patch = [&](const Patch& patch) { timed.in_host(patch, [&] { use({pass.side, patch}); }); };
    if (use_load)
      couplings.load = [&](const LoadPlace& load) { timed.in_host(load.columns, [&] { use_load(pass.side, load); }); };
    if (use_rows)
      couplings.rows = [&](const IndexedVector<TangentBlock>& rows) {
        if (!rows.empty()) timed.in_host(rows.front().rows, [&] { use_rows(pass.side, rows); });
      };
    pass.integral->geometry().for_each_coupling(couplings);
  }
}

GapReport ContactInterface::gaps(const PerSide<SurfaceFields>& fields) const {
  const TaskClock timed = measurements_.clock(Task::augmentation);
  const Index tangential = tangential_condition(effects_.acting_friction()).count();
  GapReport worst{{}, IndexedVector<FieldGap>(effects_.scalar_fields()), IndexedVector<FieldGap>(tangential)};
  for (const SidedPass& pass : passes_) {
    // Penalties of a second pass next to unknown multipliers leave gaps that no augmentation closes.
    if (pass.integral->space().has_unknown_multipliers() != this->pass(0).space().has_unknown_multipliers()) continue;
    const GapReport report = measure_gaps(*pass.integral, seen_from(pass.side, fields));
    keep_worst(worst.traction, report.traction);
    keep_worst(worst.flux, report.flux);
    keep_worst(worst.slip, report.slip);
  }
  return worst;
}

bool ContactInterface::augment(const PerSide<SurfaceFields>& fields) {
  const TaskClock timed = measurements_.clock(Task::augmentation);
  bool any_grown = false;
  for (const SidedPass& pass : passes_) {
    const GapReport report = measure_gaps(*pass.integral, seen_from(pass.side, fields));
    pass.integral->augment(seen_from(pass.side, fields));
    any_grown = grow_penalties(pass.integral->laws(), report, settings_.tolerances) || any_grown;
  }
  return any_grown;
}

UndetectedPenetration ContactInterface::check_penetration(const PerSide<SurfaceFields>& fields) {
  check_.undetected = {};
  if (settings_.two_pass || !effects_.traction || mesh_[Side::primary].may_meet_itself()) return {};
  if (are_all_joined(mesh_[Side::primary])) return {};
  const TaskClock timed = measurements_.clock(Task::augmentation);
  const NodeFlags in_contact = passes_.front().integral->flux_coupled();
  const IndexedVector<FacingNode> nodes = facing_nodes(passes_.front(), mesh_, position_, in_contact, settings_);
  const VectorXd shares = overlap_shares(nodes, with_joined(in_contact, mesh_[Side::primary]), mesh_, position_);
  const bool joins = passes_.size() == 1;
  check_.undetected = overlap_among(nodes, shares, joins ? check_.nodes : passes_.back().integral->flux_coupled());
  const UndetectedPenetration found = overlap_among(nodes, shares, check_.nodes);
  if (found.nodes == 0) return found;
  check_.nodes = with_entered(std::move(check_.nodes), nodes, shares, mesh_[Side::primary].facets.count());
  restrict_second_pass();
  find_points(passes_.back(), position_, reach_in_step(settings_, accepted_, position_));
  if (joins) passes_.back().integral->geometry().moving()->start_inactive(seen_from(Side::secondary, fields));
  return found;
}

void ContactInterface::restrict_second_pass() {
  if (passes_.size() == 1) passes_.push_back(make_pass(Side::secondary, mesh_, effects_, check_.settings));
  const ContactPass& second = *passes_.back().integral;
  second.slips().restore(second.space().facing(), seen_from(Side::secondary, pass(0).slips().state()));
  passes_.back().integral->restrict_active_set(check_.nodes);
}

void hold_loads(const ContactInterface& contact, const PerSide<SurfaceFields>& fields) {
  const TaskClock timed = contact.measurements().clock(Task::residual);
  for_each_moving(contact, [&](Side side, MovingGeometry& moving) { moving.hold_loads(seen_from(side, fields)); });
}

void forget_past(const ContactInterface& contact) {
  for_each_moving(contact, [](Side /*side*/, MovingGeometry& moving) { moving.forget_past(); });
}

}  // namespace mixture_contact
