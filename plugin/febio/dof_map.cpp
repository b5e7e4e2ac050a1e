#include "dof_map.h"

#include "contact/base/indexed_vector.h"
#include "contact/interface/multipliers.h"
#include "host/facet_material.h"
#include "newton/solver.h"

#include <FECore/FEMesh.h>
#include <FECore/FEModel.h>

#include <algorithm>

using mixture_contact::both_sides;
using mixture_contact::ContactInterface;
using mixture_contact::Index;
using mixture_contact::LocalLayout;
using mixture_contact::MultiplierLayout;
using mixture_contact::Side;

void DofMap::init() {
  front_ = face_dofs({"x", "y", "z"}, "p", "concentration");
  back_ = face_dofs({"sx", "sy", "sz"}, "q", "shell concentration");
  rotations_ = {fem_.GetDOFIndex("Ru"), fem_.GetDOFIndex("Rv"), fem_.GetDOFIndex("Rw")};
  concentrations_ = std::max(0, fem_.GetDOFS().GetVariableSize("concentration"));
}

DofMap::FaceDofs DofMap::face_dofs(const std::array<const char*, 3>& displacements, const char* pressure,
                                   const char* concentration) const {
  FaceDofs dofs;
  for (std::size_t i = 0; i < displacements.size(); ++i)
    mixture_contact::at(dofs.displacements, i) = fem_.GetDOFIndex(mixture_contact::at(displacements, i));
  dofs.pressure = fem_.GetDOFIndex(pressure);
  dofs.concentration = fem_.GetDOFIndex(concentration, 0);
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

/// Forces on the back face of a rigid shell act on its body as those on its front do, but for the director's moment
/// arm, along which a normal force turns nothing.
const std::array<int, 3>& DofMap::displacements_of(Side side, int node) const {
  return fem_.GetMesh().Node(node).m_rid >= 0 ? front_.displacements : displacements(side);
}

int DofMap::deformable_node() const {
  for (const Side side : both_sides) {
    FEMixtureSurface& surface = surfaces_[side];
    for (int i = 0; i < surface.Nodes(); ++i) {
      if (surface.Node(i).m_rid < 0) return surface.NodeIndex(i);
    }
  }
  return -1;
}

bool DofMap::has_free_node(Side side) const {
  FEMixtureSurface& surface = surfaces_[side];
  for (int i = 0; i < surface.Nodes(); ++i) {
    const std::vector<int>& own = node_equations(surface.NodeIndex(i));
    if (surface.Node(i).m_rid < 0 && std::any_of(own.begin(), own.end(), [](int equation) { return equation >= 0; }))
      return true;
  }
  return false;
}

std::vector<int> DofMap::nodes(const Location& at) const {
  std::vector<int> nodes;
  nodes.reserve(at.patch.primary.size() + at.patch.secondary.size() + 1);
  for (const int node : at.patch.primary) nodes.push_back(surfaces_[at.first].NodeIndex(node));
  for (const int node : at.patch.secondary) nodes.push_back(surfaces_[other(at.first)].NodeIndex(node));
  if (at.patch.multiplier_node) nodes.push_back(multiplier_node_);
  return nodes;
}

const std::vector<int>& DofMap::node_equations(int node) const { return fem_.GetMesh().Node(node).m_ID; }

void DofMap::add_multipliers(const ContactInterface& core, const Location& at, std::vector<int>& ids) const {
  if (!at.patch.multiplier_node) return;
  const LocalLayout layout = at.patch.layout();
  const MultiplierLayout own = multiplier_layout(core);
  const int node = *at.patch.multiplier_node;
  const int first = first_multiplier_;
  if (layout.has_displacements())
    mixture_contact::at(ids, layout.traction_multiplier()) = first + indexing::as_int(own.traction(node));
  for (Index k = 0; k < layout.scalar_fields(); ++k)
    mixture_contact::at(ids, layout.flux_multiplier(k)) = first + indexing::as_int(own.flux(
                                                                      node, mixture_contact::at(at.patch.fields, k)));
}

std::vector<int> DofMap::equations(const ContactInterface& core, const Location& at,
                                   const std::vector<int>& nodes) const {
  const LocalLayout layout = at.patch.layout();
  std::vector<int> ids(indexing::entries(layout.size()), -1);
  add_multipliers(core, at, ids);
  for (Index node = 0; node < layout.nodes(); ++node) {
    const int mesh_node = mixture_contact::at(nodes, node);
    const std::vector<int>& own = node_equations(mesh_node);
    const Side side = node < layout.primary_nodes() ? at.first : other(at.first);
    const std::array<int, 3>& displacements = displacements_of(side, mesh_node);
    for (Index i = 0; layout.has_displacements() && i < 3; ++i)
      mixture_contact::at(ids, layout.displacement(node, i)) = mixture_contact::at(
          own, mixture_contact::at(displacements, i));
    for (Index k = 0; k < layout.scalar_fields(); ++k)
      mixture_contact::at(ids, layout.scalar(node, k)) = mixture_contact::at(
          own, field(side, core.effects(), mixture_contact::at(at.patch.fields, k)));
  }
  return ids;
}

void DofMap::add_rotations(const std::vector<int>& nodes, std::vector<int>& ids) const {
  for (const int node : nodes) {
    for (const int dof : rotations_) {
      if (dof >= 0) ids.push_back(mixture_contact::at(node_equations(node), dof));
    }
  }
}

std::vector<int> DofMap::coupled(const ContactInterface& core, const Location& at) const {
  const std::vector<int> mesh_nodes = nodes(at);
  std::vector<int> ids = equations(core, at, mesh_nodes);
  // Rigid nodes bring the equations of their body's rotations in as well.
  if (at.patch.displacements) add_rotations(mesh_nodes, ids);
  for (int& id : ids) id = newton::equation_of(id);  // prescribed values have their places in the matrix, too
  return ids;
}

bool DofMap::are_rigid(const std::vector<int>& nodes) const {
  return std::any_of(nodes.begin(), nodes.end(), [&](int node) { return fem_.GetMesh().Node(node).m_rid >= 0; });
}

bool DofMap::are_prescribed(const std::vector<int>& equations) {
  return std::any_of(equations.begin(), equations.end(), [](int equation) { return newton::is_prescribed(equation); });
}
