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

SidedPass make_pass(Side side, const PerSide<SurfaceMesh>& mesh, const Effects& effects, const Settings& settings) {
  SidedPass pass;
  pass.side = side;
  pass.integral = std::make_unique<ContactPass>(mesh[side], mesh[other(side)], effects, settings);
  return pass;
}

/// The largest distance by which two surfaces may have moved relative to each other [length].
double largest_motion(const PerSide<Matrix3Xd>& from, const PerSide<Matrix3Xd>& to) {
  const Vector3d common = (to[Side::secondary] - from[Side::secondary]).rowwise().mean();
  const auto of_side = [&](Side side) {
    return ((to[side] - from[side]).colwise() - common).colwise().norm().maxCoeff();
  };
  return of_side(Side::primary) + of_side(Side::secondary);
}

/// The positions at the start of a step if they extend a search radius; else empty.
PerSide<Matrix3Xd> start_of_step(const Settings& settings, const PerSide<SurfaceMesh>& mesh,
                                 const PerSide<Matrix3Xd>& position) {
  const bool extends = settings.search.radius > 0 && !mesh[Side::primary].may_meet_itself();
  return extends ? position : PerSide<Matrix3Xd>();
}

/// The search distances in a step. Overlaps may exceed a given search radius by the motion of the step, because an
/// iteration may move a body too far. The radius of self-contact is fixed: the next fold may be within the motion.
/// `accepted`: see start_of_step().
Reach reach_in_step(const Settings& settings, const PerSide<Matrix3Xd>& accepted, const PerSide<Matrix3Xd>& position) {
  Reach reach = reach_of(settings, seen_from(Side::primary, position));
  if (accepted[Side::primary].cols() > 0) reach.moved = largest_motion(accepted, position);
  return reach;
}

void find_points(SidedPass& pass, const PerSide<Matrix3Xd>& position, const Reach& reach) {
  pass.reach = reach;
  pass.integral->project(seen_from(pass.side, position), reach);
}

/// The nodes of the other surface that face contact in the present step.
NodeFlags facing_in_step(const SidedPass& pass, const PerSide<SurfaceMesh>& mesh, const PerSide<Matrix3Xd>& position,
                         const NodeFlags& in_contact, const Settings& settings) {
  return facing_contact_in_step(pass, facing_nodes(pass, mesh, position, in_contact, settings));
}

bool has_reduced_penalty(const Settings& settings) {
  return settings.enforcement == Enforcement::penalty && settings.reduced_traction.divisor > 1;
}

/// Sets the multipliers such that the law of each node passes through the accepted load and gap. Without multipliers, a
/// reduced penalty would require an overlap that is larger by the divisor. The fraction `kept` makes the multipliers
/// decrease from step to step.
void keep_loads(ContactPass& pass, double kept) {
  NodalLaws& laws = pass.laws();
  const NodalGaps& gaps = pass.space().gaps();
  for (Index node = 0; node < laws.nodes(); ++node) {
    const double traction = laws.multipliers.accepted_traction[node];
    const bool bears = traction < 0 && gaps.faces(node);
    laws.multipliers.traction[node] = bears ? kept * (traction - laws.traction_penalty(node) * gaps.gap[node]) : 0;
  }
}

Memory memory_of(const std::vector<SidedPass>& passes) {
  Memory now;
  for (const SidedPass& pass : passes) {
    now.points += indexing::entries(point_count(pass.integral->space().facing()));
    now.bytes += pass.integral->memory();
  }
  return now;
}

/// The given nodes together with the joined nodes of a surface.
NodeFlags with_joined(NodeFlags nodes, const SurfaceMesh& mesh) {
  for (Index node = 0; node < nodes.count(); ++node) nodes[node] = nodes[node] || mesh.is_joined(node);
  return nodes;
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
  const bool search_all = search == Search::everywhere;
  if (same(Side::primary) && same(Side::secondary) && (searched_ || !search_all)) return;
  position_ = position;
  searched_ = search_all;
  if (accepted_[Side::primary].cols() == 0) accepted_ = start_of_step(settings_, mesh_, position_);
  for (SidedPass& pass : passes_) {
    pass.hits.reset();
    pass.integral->slips().begin_at(seen_from(pass.side, position_));
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
  accepted_ = start_of_step(settings_, mesh_, {{fields[Side::primary].position, fields[Side::secondary].position}});
  if (changes_averages) end_iterations();
}

void ContactInterface::forget_steps() {
  accepted_ = {};
  for (SidedPass& pass : passes_) {
    pass.integral->laws().forget_steps();
    pass.integral->slips().forget();
    pass.faced_before = {};
  }
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
  for_each_moving(*this, [&](Side side, MovingGeometry& moving) {
    changed = moving.begin_iteration(seen_from(side, fields)) || changed;
  });
  for (const SidedPass& pass : passes_) timed.take(pass.integral->space().effect_times(), thread_count());
  measurements_.note(memory_of(passes_));
  return changed;
}

void ContactInterface::linearise_at(const PerSide<SurfaceFields>& fields) const {
  for_each_moving(*this, [&](Side side, MovingGeometry& moving) { moving.linearise_at(seen_from(side, fields)); });
}

void ContactInterface::end_iterations() {
  for (SidedPass& pass : passes_) {
    pass.faced.reset();
    pass.integral->geometry().end_iterations();
    if (has_reduced_penalty(settings_)) keep_loads(*pass.integral, settings_.reduced_traction.kept);
  }
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
  GapReport worst{{},
                  IndexedVector<FieldGap>(effects_.scalar_fields()),
                  IndexedVector<FieldGap>(pass(0).laws().tangential_conditions())};
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

PerSide<NodeFlags> ContactInterface::hold_nodes_in_contact() {
  {
    const TaskClock timed = measurements_.clock(Task::stiffness);
    for (SidedPass& pass : passes_)
      hold_facing(pass, facing_in_step(pass, mesh_, position_, pass.integral->flux_coupled(), settings_));
  }
  PerSide<NodeFlags> nodes = nodes_in_contact();
  for (const Side side : both_sides) nodes[side] = with_joined(std::move(nodes[side]), mesh_[side]);
  return nodes;
}

UndetectedPenetration ContactInterface::check_penetration(const PerSide<SurfaceFields>& fields) {
  check_.undetected = {};
  if (settings_.two_pass || !effects_.traction || mesh_[Side::primary].may_meet_itself()) return {};
  const TaskClock timed = measurements_.clock(Task::augmentation);
  const IndexedVector<Facet>& facets = mesh_[Side::primary].facets;
  const NodeFlags in_contact = passes_.front().integral->flux_coupled();
  const IndexedVector<FacingNode> nodes = facing_nodes(passes_.front(), mesh_, position_, in_contact, settings_);
  const VectorXd shares = overlap_shares(nodes, with_joined(in_contact, mesh_[Side::primary]), facets,
                                         position_[Side::primary]);
  const bool joins = passes_.size() == 1;
  check_.undetected = overlap_among(nodes, shares, joins ? check_.nodes : passes_.back().integral->flux_coupled());
  const UndetectedPenetration found = overlap_among(nodes, shares, check_.nodes);
  if (found.nodes == 0) return found;
  check_.nodes = with_entered(std::move(check_.nodes), nodes, shares, facets.count());
  restrict_second_pass();
  find_points(passes_.back(), position_, reach_in_step(settings_, accepted_, position_));
  if (joins) passes_.back().integral->geometry().moving()->start_inactive(seen_from(Side::secondary, fields));
  return found;
}

void ContactInterface::restrict_second_pass() {
  if (passes_.size() == 1) passes_.push_back(make_pass(Side::secondary, mesh_, effects_, check_.settings));
  passes_.back().integral->slips().restore(seen_from(Side::secondary, pass(0).slips().state()));
  passes_.back().integral->restrict_active_set(check_.nodes);
}

ContactInterface::State ContactInterface::state() const {
  State state;
  for (int node = 0; node < check_.nodes.count(); ++node) {
    if (check_.nodes[node]) state.check_nodes.push_back(node);
  }
  for (const SidedPass& pass : passes_) {
    state.multipliers.push_back(pass.integral->laws().multipliers);
    state.carriers.push_back(pass.integral->space().boundary_weights().last_decisions());
    state.faced.push_back(pass.faced_before);
  }
  state.slips_from = pass(0).slips().state();
  return state;
}

void ContactInterface::restore(State state) {
  check(state, mesh_, effects_, settings_.two_pass);
  accepted_ = {};
  pass(0).slips().restore(seen_from(Side::primary, state.slips_from));
  NodeFlags check_nodes(check_.nodes.count(), false);
  for (const int node : state.check_nodes) check_nodes[node] = true;
  if (check_nodes != check_.nodes) {
    check_.nodes = std::move(check_nodes);
    passes_.erase(passes_.begin() + 1, passes_.end());
    if (!state.check_nodes.empty()) restrict_second_pass();
    for (Matrix3Xd& position : position_) position.resize(3, 0);
  }
  for (std::size_t pass = 0; pass < passes_.size(); ++pass) {
    passes_[pass].integral->laws().multipliers = std::move(state.multipliers[pass]);
    passes_[pass].integral->slips().restore(seen_from(passes_[pass].side, state.slips_from));
  }
  end_iterations();
  forget_past(*this);
  for (std::size_t pass = 0; pass < passes_.size(); ++pass) {
    passes_[pass].integral->restore_carriers(std::move(state.carriers[pass]));
    passes_[pass].faced_before = std::move(state.faced[pass]);
  }
}

PerSide<NodeFlags> ContactInterface::nodes_in_contact() const {
  const TaskClock timed = measurements_.clock(Task::stiffness);
  PerSide<NodeFlags> in_contact;
  for (const Side side : both_sides) in_contact[side] = NodeFlags(mesh_[side].nodes, false);
  const auto add = [&](Side side, const NodeFlags& found) {
    for (Index node = 0; node < found.count(); ++node) {
      if (found[node]) in_contact[side][node] = true;
    }
  };
  for (const SidedPass& pass : passes_) {
    const NodeFlags own = pass.integral->flux_coupled();
    add(pass.side, own);
    add(other(pass.side), pass.faced ? *pass.faced : facing_in_step(pass, mesh_, position_, own, settings_));
  }
  return in_contact;
}

void ContactInterface::update_properties(PerSide<VectorXd> stiffness, PerSide<MatrixXd> conductance) {
  for (const Side side : both_sides) {
    mesh_[side].stiffness = std::move(stiffness[side]);
    mesh_[side].conductance = std::move(conductance[side]);
  }
  for (const SidedPass& pass : passes_) pass.integral->laws().update_penalties();
}

void ContactInterface::update_laws(const Settings& settings) {
  const bool same = same_penalties(settings_, settings);
  const bool was_reduced = has_reduced_penalty(settings_);
  settings_.tolerances = settings.tolerances;
  settings_.friction = settings.friction;
  settings_.gap.offset = settings.gap.offset;
  for (const SidedPass& pass : passes_) pass.integral->update(settings);
  settings_.traction = settings.traction;
  settings_.solvent = settings.solvent;
  settings_.solute = settings.solute;
  settings_.membrane = settings.membrane;
  settings_.reduced_traction = settings.reduced_traction;
  check_.settings = settings_of_check(settings_);
  for (const SidedPass& pass : passes_) {
    NodalLaws& laws = pass.integral->laws();
    if (!same) laws.update_penalties();
    if (was_reduced) laws.multipliers.traction.setZero();  // a penalty at its full value has no multipliers
    if (has_reduced_penalty(settings_)) keep_loads(*pass.integral, settings_.reduced_traction.kept);
  }
}

bool faces_as_held(const ContactInterface& contact) {
  return std::all_of(contact.passes_.begin(), contact.passes_.end(), [&](const SidedPass& pass) {
    if (!pass.faced) return true;
    NodeFlags facing = facing_in_step(pass, contact.mesh_, contact.position_, pass.integral->flux_coupled(),
                                      contact.settings_);
    return next_facing(pass, std::move(facing)) == *pass.faced;
  });
}

bool reconsiders_edge(ContactInterface& contact, const PerSide<SurfaceFields>& fields) {
  const TaskClock timed = contact.measurements().clock(Task::augmentation);
  bool any = false;
  for_each_moving(contact, [&](Side side, MovingGeometry& moving) {
    any = moving.reconsiders_edge(seen_from(side, fields)) || any;
  });
  for (SidedPass& pass : contact.passes_) {
    if (!pass.faced) continue;
    const NodeFlags facing = facing_in_step(pass, contact.mesh_, contact.position_, pass.integral->flux_coupled(),
                                            contact.settings_);
    any = reconsiders_facing(pass, facing) || any;
  }
  return any;
}

void join(ContactInterface& contact, PerSide<NodeFlags> nodes) {
  for (const Side side : both_sides) contact.mesh_[side].joined = std::move(nodes[side]);
  for (SidedPass& pass : contact.passes_) {
    pass.faced.reset();
    pass.integral->restrict_active_set(NodeFlags(contact.mesh_[pass.side].nodes, true));
  }
  if (any(contact.check_.nodes)) contact.restrict_second_pass();
  contact.end_iterations();
  for (Matrix3Xd& position : contact.position_) position.resize(3, 0);
}

void set_immovable(ContactInterface& contact, PerSide<NodeFlags> nodes) {
  const bool is_new = std::any_of(both_sides.begin(), both_sides.end(),
                                  [&](Side side) { return nodes[side] != contact.mesh_[side].immovable; });
  if (!is_new) return;
  for (const Side side : both_sides) contact.mesh_[side].immovable = std::move(nodes[side]);
  for (const SidedPass& pass : contact.passes_) pass.integral->laws().update_penalties();
}

void hold_loads(const ContactInterface& contact, const PerSide<SurfaceFields>& fields) {
  const TaskClock timed = contact.measurements().clock(Task::residual);
  for_each_moving(contact, [&](Side side, MovingGeometry& moving) { moving.hold_loads(seen_from(side, fields)); });
}

void forget_past(const ContactInterface& contact) {
  for_each_moving(contact, [](Side /*side*/, MovingGeometry& moving) { moving.forget_past(); });
}

}  // namespace mixture_contact
