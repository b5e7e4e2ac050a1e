/// The materials behind the facets of a contact, as hosts find them and as the core takes them.
#pragma once

#include "contact/interface/interface.h"
#include "exchange.h"

#include <map>
#include <string>
#include <vector>

/// Properties of the element behind a facet, per area and over the element's thickness in the reference configuration.
struct FacetMaterial {
  double thickness = 0;     ///< of the element [mm]
  double stiffness = 0;     ///< normal stiffness over thickness [N/mm^3]; infinite if rigid
  double crossing = 0;      ///< time in which sound crosses the element along the facet's normal [s]; 0 if rigid
  bool permeable = false;   ///< whether the solvent can pass
  double permeability = 0;  ///< hydraulic permeability over thickness [mm^3/(N s)]
  std::map<int, double>
      solutes;  ///< solute index -> porosity x solubility x diffusivity over thickness, plus convection [mm/s]
};

/// The materials behind all facets of the two surfaces.
using FacetMaterials = mixture_contact::PerSide<std::vector<FacetMaterial>>;

/// The solvent and the solutes of a model, by their names, as a contact between these surfaces finds them: a field that
/// a surface lacks everywhere is an obstacle.
std::vector<FieldAtContact> fields_at_contact(const FacetMaterials& materials,
                                              const mixture_contact::PerSide<std::string>& surfaces,
                                              const std::vector<std::string>& solutes);

/// Whether the material behind any facet of either surface contains a fluid.
bool has_fluid(const FacetMaterials& materials);

/// Whether hard contact would open and close in turn in steps of `dt` [s].
///
/// Hard contact stops a node within a step. The trapezoidal rule reverses the velocity v of a node that rests, and the
/// force of its inertia alternates by 4 m v/dt = 2 rho h v/dt per area, with half the mass of an element of thickness
/// h. The wave in the body carries rho c v. A node therefore stays in contact if c dt > 2 h.
bool would_rebound(const FacetMaterials& materials, double dt);

/// Sets the materials behind the facets of a mesh.
void set_materials(mixture_contact::SurfaceMesh& mesh, const std::vector<FacetMaterial>& materials,
                   const mixture_contact::Effects& effects);

/// Gives the core the present materials, for its automatic penalties.
void update_materials(mixture_contact::ContactInterface& core, const FacetMaterials& materials);

/// The solute that a field in the order of Effects is; -1: the solvent, exchanged or read by friction alone.
int solute_of(const mixture_contact::Effects& effects, int field);
/// The solute of each exchanged field, as solute_of() numbers it.
std::vector<int> exchanged_solutes(const mixture_contact::Effects& effects);
