#include "enforcement/moving_geometry.h"
#include "interface/interface.h"

#include <algorithm>

// The state of a contact between steps, and changes of its surfaces, properties and laws.

namespace mixture_contact {
namespace {

bool has_reduced_penalty(const Settings& settings) {
  return settings.enforcement == Enforcement::penalty && settings.reduced_traction.divisor > 1;
}

/// With a reduced penalty, sets the multipliers such that the law of each node passes through the accepted load and
/// gap. Without multipliers, the penalty would require an overlap that is larger by the divisor. Only a fraction of the
/// multipliers is kept, and they decrease from step to step.
void keep_loads(ContactPass& pass, const Settings& settings) {
  if (!has_reduced_penalty(settings)) return;
  NodalLaws& laws = pass.laws();
  const NodalGaps& gaps = pass.space().gaps();
  const double kept = settings.reduced_traction.kept;
  for (Index node = 0; node < laws.nodes(); ++node) {
    const double traction = laws.multipliers.accepted_traction[node];
    const bool bears = traction < 0 && gaps.faces(node);
    laws.multipliers.traction[node] = bears ? kept * (traction - laws.traction_penalty(node) * gaps.gap[node]) : 0;
  }
}

}  // namespace

void ContactInterface::end_iterations() {
  for (SidedPass& pass : passes_) {
    pass.faced.reset();
    pass.integral->geometry().end_iterations();
    keep_loads(*pass.integral, settings_);
  }
}

void ContactInterface::forget_steps() {
  accepted_ = {};
  for (SidedPass& pass : passes_) {
    pass.integral->laws().forget_steps();
    pass.integral->slips().forget();
    pass.faced_before = {};
  }
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
  state.overlap = accepted_.overlap;
  return state;
}

void ContactInterface::restore(State state) {
  check(state, mesh_, effects_, settings_.two_pass);
  accepted_ = {{}, state.overlap};
  pass(0).slips().restore(pass(0).space().facing(), seen_from(Side::primary, state.slips_from));
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
    const ContactPass& integral = *passes_[pass].integral;
    integral.slips().restore(integral.space().facing(), seen_from(passes_[pass].side, state.slips_from));
  }
  end_iterations();
  forget_past(*this);
  for (std::size_t pass = 0; pass < passes_.size(); ++pass) {
    passes_[pass].integral->restore_carriers(std::move(state.carriers[pass]));
    passes_[pass].faced_before = std::move(state.faced[pass]);
  }
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
  for (const SidedPass& pass : passes_) {
    pass.integral->measure_gaps_from(settings.gap.offset);
    pass.integral->slips().measure_pressure_from(settings.friction.ambient_pressure);
  }
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
    keep_loads(*pass.integral, settings_);
  }
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

}  // namespace mixture_contact
