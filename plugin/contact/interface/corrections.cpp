#include "interface/corrections.h"

#include "enforcement/held_linearisation.h"

namespace mixture_contact {
namespace {

/// Calls use(side, geometry) for each pass.
template <class Contact, class Use>
void for_each_geometry(Contact& contact, const Use& use) {
  for (std::size_t pass = 0; pass < contact.passes(); ++pass) use(both_sides.at(pass), contact.pass(pass).geometry());
}

bool is_correctable(const HeldLinearisation* held) { return held != nullptr && held->is_correctable(); }

/// Calls use(side, held) for each pass whose linearisation can be corrected.
template <class Contact, class Use>
void for_each_correctable(Contact& contact, const Use& use) {
  for_each_geometry(contact, [&](Side side, ContactGeometry& geometry) {
    if (is_correctable(geometry.held())) use(side, *geometry.held());
  });
}

PerSide<NodeFlags> no_nodes(const ContactInterface& contact) {
  PerSide<NodeFlags> nodes;
  for (const Side side : both_sides) nodes[side] = NodeFlags(contact.mesh(side).nodes, false);
  return nodes;
}

}  // namespace

bool serves_again(const ContactInterface& contact, const PerSide<SurfaceFields>& fields) {
  bool any_correctable = false;
  for_each_correctable(contact, [&](Side, const HeldLinearisation&) { any_correctable = true; });
  if (!any_correctable) return contact.is_solution(fields);
  if (!faces_as_held(contact)) return false;
  const TaskClock timed = contact.measurements().clock(Task::augmentation);
  bool all = true;
  for_each_geometry(contact, [&](Side side, ContactGeometry& geometry) {
    const FacingFields seen = seen_from(side, fields);
    const HeldLinearisation* const held = geometry.held();
    all = all && (is_correctable(held) ? held->serves(seen) : geometry.is_solution(seen));
  });
  return all;
}

bool correct(ContactInterface& contact, const PerSide<SurfaceFields>& fields) {
  const TaskClock timed = contact.measurements().clock(Task::stiffness);
  bool changed = false;
  for_each_geometry(contact, [&](Side side, ContactGeometry& geometry) {
    if (is_correctable(geometry.held())) {
      changed = geometry.held()->correct(seen_from(side, fields)) || changed;
    } else if (geometry.held() != nullptr) {
      geometry.held()->keep();
    }
  });
  return changed;
}

bool residual_change(const ContactInterface& contact, const PerSide<SurfaceFields>& fields, double dt,
                     const ContactInterface::AddResidual& add) {
  TaskClock timed = contact.measurements().clock(Task::residual);
  bool is_known = true;
  for_each_geometry(contact, [&](Side side, ContactGeometry& geometry) {
    const HeldLinearisation* const held = geometry.held();
    if (held == nullptr || !is_known) return;  // fixed surfaces have no linearisation, and nothing changes
    is_known = held->residual_change(seen_from(side, fields), dt, [&](const Patch& patch, const VectorXd& values) {
      timed.in_host([&] { add({side, patch}, values); });
    });
  });
  return is_known;
}

void has_matrix(ContactInterface& contact, const PerSide<bool>& has_loads, const PerSide<NodeFlags>& rigid) {
  for_each_geometry(contact, [&](Side side, ContactGeometry& geometry) {
    if (HeldLinearisation* const held = geometry.held())
      held->has_matrix({has_loads[side], rigid[side], rigid[other(side)]});
  });
}

bool may_decide(const ContactInterface& contact) {
  bool found = false;
  for_each_correctable(contact,
                       [&](Side /*side*/, const HeldLinearisation& held) { found = found || held.may_decide(); });
  return found;
}

PerSide<NodeFlags> find_nearing_nodes(ContactInterface& contact, const PerSide<Matrix3Xd>& displacements,
                                      const PerSide<SurfaceFields>& fields) {
  const TaskClock timed = contact.measurements().clock(Task::stiffness);
  PerSide<NodeFlags> found = no_nodes(contact);
  for_each_correctable(contact, [&](Side side, HeldLinearisation& held) {
    found[side] = held.find_nearing(seen_from(side, displacements), seen_from(side, fields));
  });
  return found;
}

PerSide<NodeFlags> nearing_nodes(const ContactInterface& contact) {
  PerSide<NodeFlags> nodes = no_nodes(contact);
  for_each_correctable(contact, [&](Side side, const HeldLinearisation& held) {
    for (const int node : held.nearing()) nodes[side][node] = true;
  });
  return nodes;
}

void nearing_loads(const ContactInterface& contact, double dt, const ContactInterface::AddLoadTangent& add) {
  for_each_correctable(contact, [&](Side side, const HeldLinearisation& held) {
    held.add_loads(held.nearing(), dt, [&](const LoadBlock& load) { add(side, load); });
  });
}

PerSide<VectorXd> undecided_tractions(const ContactInterface& contact, const PerSide<SurfaceFields>& fields) {
  PerSide<VectorXd> tractions;
  for (const Side side : both_sides) tractions[side] = unknown_values(contact.mesh(side).nodes);
  for_each_correctable(contact, [&](Side side, const HeldLinearisation& held) {
    tractions[side] = held.undecided(seen_from(side, fields));
  });
  return tractions;
}

PerSide<NodeFlags> opening_nodes(const ContactInterface& contact, const PerSide<VectorXd>& tractions,
                                 const PerSide<NodeFlags>& opened) {
  PerSide<NodeFlags> found = opened;
  for_each_correctable(contact, [&](Side side, const HeldLinearisation& held) {
    found[side] = held.opening(tractions[side], opened[side]);
  });
  return found;
}

void open_nodes(ContactInterface& contact, const PerSide<NodeFlags>& nodes, const PerSide<SurfaceFields>& fields) {
  const TaskClock timed = contact.measurements().clock(Task::stiffness);
  for_each_geometry(contact, [&](Side side, ContactGeometry& geometry) {
    if (HeldLinearisation* const held = geometry.held()) held->open(nodes[side], seen_from(side, fields));
  });
}

std::vector<ReleasedNode> released_nodes(const ContactInterface& contact) {
  std::vector<ReleasedNode> found;
  for_each_correctable(contact, [&](Side side, const HeldLinearisation& held) {
    for (const int node : held.released()) found.push_back({side, node});
  });
  return found;
}

void added_loads(const ContactInterface& contact, double dt, const ContactInterface::AddLoadTangent& add) {
  for_each_correctable(contact, [&](Side side, const HeldLinearisation& held) {
    held.add_loads(held.added(), dt, [&](const LoadBlock& load) { add(side, load); });
  });
}

}  // namespace mixture_contact
