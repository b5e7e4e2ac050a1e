#include "dof_map.h"

#include "contact/base/indexed_vector.h"
#include "host/facet_material.h"
#include "linear_constraints.h"

#include <FEBioMech/FEMechModel.h>
#include <FEBioMech/FERigidBody.h>
#include <FECore/FEMesh.h>
#include <FECore/FEModel.h>

#include <algorithm>
#include <iterator>

using mixture_contact::both_sides;
using mixture_contact::Side;

void DofMap::init() {
  front_ = face_dofs({"x", "y", "z"}, "p", "concentration");
  back_ = face_dofs({"sx", "sy", "sz"}, "q", "shell concentration");
  rotations_ = {fem().GetDOFIndex("Ru"), fem().GetDOFIndex("Rv"), fem().GetDOFIndex("Rw")};
  concentrations_ = std::max(0, fem().GetDOFS().GetVariableSize("concentration"));
}

DofMap::FaceDofs DofMap::face_dofs(const std::array<const char*, 3>& displacements, const char* pressure,
                                   const char* concentration) const {
  FaceDofs dofs;
  for (std::size_t i = 0; i < displacements.size(); ++i)
    mixture_contact::at(dofs.displacements, i) = fem().GetDOFIndex(mixture_contact::at(displacements, i));
  dofs.pressure = fem().GetDOFIndex(pressure);
  dofs.concentration = fem().GetDOFIndex(concentration, 0);
  return dofs;
}

void DofMap::number_multipliers(int first) {
  first_multiplier_ = first;
  multiplier_node_ = deformable_node();
}

void DofMap::serialize(DumpStream& ar) {
  ar & concentrations_ & first_multiplier_ & multiplier_node_;
  for (int& dof : rotations_) ar & dof;
  for (FaceDofs* face : {&front_, &back_}) {
    ar & face->pressure & face->concentration;
    for (int& dof : face->displacements) ar & dof;
  }
}

int DofMap::field(Side side, const mixture_contact::Effects& effects, int field) const {
  const int solute = solute_of(effects, field);
  return solute < 0 ? pressure(side) : concentration(side, solute);
}

/// Forces on the back face of a rigid shell act on the body's degrees of freedom in the same way as those on its front
/// face. Only the moment arm differs by the director, and a normal force has no moment about it.
const std::array<int, 3>& DofMap::displacements(Side side, const FENode& node) const {
  return node.m_rid >= 0 ? front_.displacements : displacements(side);
}

int DofMap::deformable_node() const {
  const LinearConstraints constraints(fem());
  int bound = -1;
  for (const Side side : both_sides) {
    FEMixtureSurface& surface = surfaces_[side];
    for (int i = 0; i < surface.Nodes(); ++i) {
      if (surface.Node(i).m_rid >= 0) continue;
      bound = surface.NodeIndex(i);
      if (!constraints.bind(bound)) return bound;
    }
  }
  return bound;
}

bool DofMap::has_free_node(Side side) const {
  FEMixtureSurface& surface = surfaces_[side];
  for (int i = 0; i < surface.Nodes(); ++i) {
    const std::vector<int>& own = surface.Node(i).m_ID;
    if (surface.Node(i).m_rid < 0 && std::any_of(own.begin(), own.end(), [](int equation) { return equation >= 0; }))
      return true;
  }
  return false;
}

bool DofMap::can_move(const FENode& node, const std::array<int, 3>& displacements) const {
  const auto is_unknown = [](int equation) { return equation >= 0; };
  if (node.m_rid < 0)
    return std::any_of(displacements.begin(), displacements.end(),
                       [&](int dof) { return is_unknown(mixture_contact::at(node.m_ID, dof)); });
  auto* const mechanics = dynamic_cast<FEMechModel*>(&fem());
  if (mechanics == nullptr) return false;
  const auto& equations = mechanics->GetRigidBody(node.m_rid)->m_LM;
  return std::any_of(std::begin(equations), std::end(equations), is_unknown);
}

mixture_contact::NodeFlags DofMap::immovable_nodes(Side side) const {
  const LinearConstraints constraints(fem());
  FEMixtureSurface& surface = surfaces_[side];
  mixture_contact::NodeFlags immovable(surface.Nodes(), false);
  for (int i = 0; i < surface.Nodes(); ++i)
    immovable[i] = !constraints.bind(surface.NodeIndex(i)) && !can_move(surface.Node(i), displacements(side));
  return immovable;
}

bool DofMap::has_free_rigid_body(Side side) const {
  FEMixtureSurface& surface = surfaces_[side];
  for (int i = 0; i < surface.Nodes(); ++i) {
    if (surface.Node(i).m_rid >= 0 && can_move(surface.Node(i), displacements(side))) return true;
  }
  return false;
}
