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

/// The pressure and the concentrations of a face.
std::vector<Place> places_of(const DofMap& dofs, const std::pair<int, bool>& face) {
  const auto [node, is_back] = face;
  std::vector<Place> places{{node, dofs.pressure(is_back)}};
  for (int k = 0; k < dofs.concentrations(); ++k) places.push_back({node, dofs.concentration(is_back, k)});
  return places;
}

/// True if ambient conditions may act on a nodal value: it exists, and no boundary condition prescribes it.
bool is_free(FEModel& fem, const newton::Solver& solver, Place place) {
  return place.dof >= 0 && fem.GetMesh().Node(place.node).get_bc(place.dof) == DOF_OPEN && solver.equation(place) != -1;
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

bool AmbientConditions::release(newton::Solver& solver, Place place) {
  if (!newton::release_with_value(solver, place)) return false;
  released_.push_back(place);
  return true;
}

bool AmbientConditions::apply(FEModel& fem, newton::Solver& solver, newton::Helpers& helpers,
                              const std::vector<ContactInModel*>& contacts) {
  if (contacts.empty()) return false;
  const DofMap& dofs = contacts.front()->bound().dofs();
  if (dofs.pressure(false) < 0) return false;
  bool changed = false;
  for (const auto& [face, status] : status_of_nodes(contacts)) {
    for (const Place place : places_of(dofs, face)) {
      if (!is_free(fem, solver, place) || helpers.keeps(place, status.in_contact)) continue;
      const bool acts = status.in_contact ? release(solver, place)
                                          : newton::hold_at(solver, place, status.ambient->ambient_value(place.dof));
      changed = changed || acts;
    }
  }
  return changed;
}

void AmbientConditions::begin_step(newton::Solver& solver) {
  for (const Place place : released_) newton::synchronise(solver, place);
  released_.clear();
}
