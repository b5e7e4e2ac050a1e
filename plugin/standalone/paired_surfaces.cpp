#include "paired_surfaces.h"

#include "hexahedron.h"

#include <algorithm>
#include <limits>
#include <set>

namespace standalone {
namespace {

using mixture_contact::both_sides;
using mixture_contact::Effects;
using mixture_contact::Facet;
using mixture_contact::Side;
using mixture_contact::SurfaceFields;
using mixture_contact::SurfaceMesh;

/// The nodes of the facets, ascending and without repetition.
std::vector<int> nodes_of(const std::vector<SurfaceFacet>& facets) {
  std::set<int> nodes;
  for (const SurfaceFacet& facet : facets)
    nodes.insert(facet.facet.nodes.begin(), facet.facet.nodes.begin() + node_count(facet.facet.type));
  return {nodes.begin(), nodes.end()};
}

/// Row of an exchanged field in a matrix of nodal values.
int dof_of(const Effects& effects, int field) {
  const int solute = solute_of(effects, field);
  return solute < 0 ? pressure_dof : concentration_dof(solute);
}

}  // namespace

PairedSurfaces::PairedSurfaces(const PerSide<std::string>& names, const Bodies& bodies) : bodies_(bodies) {
  for (const Side side : both_sides) {
    facets_[side] = model().mesh.surfaces.at(names[side]);
    nodes_[side] = nodes_of(facets_[side]);
  }
}

bool PairedSurfaces::can_move() const {
  std::set<int> fixed;
  for (const Condition& condition : model().prescribed) {
    for (const int node : condition.nodes) {
      if (condition.fixed) fixed.insert(model().place(condition.dof, node));
    }
  }
  const auto moves = [&](int node) {
    return fixed.count(model().place(0, node)) + fixed.count(model().place(1, node)) +
               fixed.count(model().place(2, node)) <
           3;
  };
  return std::any_of(both_sides.begin(), both_sides.end(),
                     [&](Side side) { return std::any_of(nodes_[side].begin(), nodes_[side].end(), moves); });
}

FacetMaterial PairedSurfaces::material(const SurfaceFacet& facet, const MatrixXd& values) const {
  const auto element = entries(facet.element);
  const Material& material = bodies_.material(element);
  FacetMaterial found;
  Vector3d area(0, 0, 0);
  for (const FacetPoint& point : facet_points(facet.facet, model().mesh.nodes)) area += point.area;
  const double thickness = bodies_.volume(element) / area.norm();
  found.thickness = thickness;
  found.stiffness = std::numeric_limits<double>::infinity();
  if (material.rigid) return found;
  found.stiffness = material.modulus / thickness;
  found.permeable = material.porous;
  found.permeability = material.permeability / thickness;
  if (material.solute) {
    const Solute& solute = *material.solute;
    const double convection = std::abs(bodies_.average(element, values).solvent_flux.dot(area.normalized()));
    const double spread = (1 - material.solid_fraction) * solute.diffusivity / thickness;
    const double carried = solute.diffusivity / solute.free_diffusivity * convection;
    found.solutes[solute.index] = solute.solubility * (spread + carried);
  }
  return found;
}

FacetMaterials PairedSurfaces::materials(const MatrixXd& values) const {
  FacetMaterials all;
  for (const Side side : both_sides) {
    for (const SurfaceFacet& facet : facets_[side]) all[side].push_back(material(facet, values));
  }
  return all;
}

mixture_contact::PerSide<SurfaceMesh> PairedSurfaces::meshes(const FacetMaterials& materials,
                                                             const Effects& effects) const {
  PerSide<SurfaceMesh> all{{mesh(Side::primary), mesh(Side::secondary)}};
  for (const Side side : both_sides) set_materials(all[side], materials[side], effects);
  return all;
}

SurfaceMesh PairedSurfaces::mesh(Side side) const {
  const std::vector<int>& nodes = nodes_[side];
  SurfaceMesh found;
  found.nodes = number_of(nodes);
  for (const SurfaceFacet& facet : facets_[side]) {
    Facet local = facet.facet;
    for (int a = 0; a < node_count(local.type); ++a) {
      int& node = at(local.nodes, a);
      node = static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
    }
    found.facets.push_back(local);
  }
  return found;
}

mixture_contact::PerSide<Matrix3Xd> PairedSurfaces::positions(const MatrixXd& values) const {
  PerSide<Matrix3Xd> all;
  for (const Side side : both_sides)
    all[side] = model().mesh.nodes(Eigen::all, nodes_[side]) + values.topRows<3>()(Eigen::all, nodes_[side]);
  return all;
}

mixture_contact::PerSide<SurfaceFields> PairedSurfaces::fields(const MatrixXd& values, const Effects& effects) const {
  PerSide<SurfaceFields> all;
  PerSide<Matrix3Xd> position = positions(values);
  const int count = effects.nodal_fields();
  for (const Side side : both_sides) {
    all[side].position = std::move(position[side]);
    all[side].scalar.resize(count_of(nodes_[side]), count);
    for (int k = 0; k < count; ++k) all[side].scalar.col(k) = values(dof_of(effects, k), nodes_[side]).transpose();
  }
  return all;
}

std::vector<int> PairedSurfaces::places(const mixture_contact::Patch& patch, Side first, const Effects& effects) const {
  const mixture_contact::LocalLayout layout = patch.layout();
  mixture_contact::IndexedVector<int> all(layout.size());
  for (Index a = 0; a < layout.nodes(); ++a) {
    const Side side = a < layout.primary_nodes() ? first : other(first);
    const int node = at(nodes_[side], patch.node(a));
    for (int i = 0; layout.has_displacements() && i < 3; ++i) {
      all[layout.displacement(a, i)] = model().place(i, node);
    }
    for (Index k = 0; k < layout.scalar_fields(); ++k) {
      all[layout.scalar(a, k)] = model().place(dof_of(effects, patch.fields[k]), node);
    }
  }
  return all;
}

}  // namespace standalone
