#include "ambient_conditions.h"

#include "contact/base/indexed_vector.h"
#include "solver/held_values.h"

#include <FECore/FEMesh.h>
#include <FECore/FEModel.h>

using mixture_contact::both_sides;
using mixture_contact::Side;
using newton::Place;

namespace {

/// The face (see AmbientConditions::Face) of a node of a surface.
std::pair<int, bool> face_of(const FEMixtureSurface& surface, int node) {
  return {surface.NodeIndex(node), surface.has_shell_bottoms()};
}

}  // namespace

std::map<AmbientConditions::Face, AmbientConditions::NodeStatus> AmbientConditions::status_of_nodes(
    const std::vector<ContactInModel*>& contacts) {
  std::map<Face, NodeStatus> nodes;
  for (ContactInModel* contact : contacts) {
    if (!contact->bound().parameters().ambient.free_draining) continue;
    for (const Side side : both_sides) {
      const FEMixtureSurface& surface = contact->bound().surfaces()[side];
      for (int i = 0; i < surface.Nodes(); ++i) nodes.insert({face_of(surface, i), {false, contact}});
    }
  }
  if (nodes.empty()) return nodes;
  for (ContactInModel* contact : contacts) {
    const auto in_contact = contact->bound().core().hold_nodes_in_contact();
    for (const Side side : both_sides) {
      const FEMixtureSurface& surface = contact->bound().surfaces()[side];
      for (int i = 0; i < surface.Nodes(); ++i) {
        const auto found = nodes.find(face_of(surface, i));
        if (found != nodes.end() && mixture_contact::at(in_contact[side], i)) found->second.in_contact = true;
      }
    }
  }
  return nodes;
}

/// True if ambient conditions may act on a nodal value: it exists, and no boundary condition prescribes it.
bool AmbientConditions::is_free(Place place) const {
  return place.dof >= 0 && fem_.GetMesh().Node(place.node).get_bc(place.dof) == DOF_OPEN &&
         solver_.equation(place) != -1;
}

bool AmbientConditions::release(Place place) {
  if (!newton::release_with_value(solver_, place)) return false;
  released_.push_back(place);
  return true;
}

bool AmbientConditions::apply(Place place, const NodeStatus& status) {
  if (!is_free(place) || helpers_.keeps(place, status.in_contact)) return false;
  if (status.in_contact) return release(place);
  return newton::hold_at(solver_, place, status.ambient->ambient_value(place.dof));
}

bool AmbientConditions::apply(const DofMap& dofs, const Face& face, const NodeStatus& status) {
  const auto [node, is_back] = face;
  bool changed = apply({node, dofs.pressure(is_back)}, status);
  for (int k = 0; k < dofs.concentrations(); ++k) {
    changed = apply({node, dofs.concentration(is_back, k)}, status) || changed;
  }
  return changed;
}

bool AmbientConditions::apply(const std::vector<ContactInModel*>& contacts) {
  if (contacts.empty()) return false;
  const DofMap& dofs = contacts.front()->bound().dofs();
  if (dofs.pressure(false) < 0) return false;
  bool changed = false;
  for (const auto& [face, status] : status_of_nodes(contacts)) changed = apply(dofs, face, status) || changed;
  return changed;
}

void AmbientConditions::begin_step() {
  for (const Place place : released_) newton::synchronise(solver_, place);
  released_.clear();
}
