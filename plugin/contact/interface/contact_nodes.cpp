#include "enforcement/moving_geometry.h"
#include "interface/interface.h"

#include <algorithm>

// The nodes of both surfaces that are in contact: those of the passes, and those that face them.

namespace mixture_contact {
namespace {

/// The nodes of the other surface that face contact in the present step.
NodeFlags facing_in_step(const SidedPass& pass, const PerSide<SurfaceMesh>& mesh, const PerSide<Matrix3Xd>& position,
                         const NodeFlags& in_contact, const Settings& settings) {
  return facing_contact_in_step(pass, facing_nodes(pass, mesh, position, in_contact, settings));
}

}  // namespace

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

}  // namespace mixture_contact
