/// The materials behind the facets of a contact, as hosts find them, and their transfer to the contact core.
#pragma once

#include "contact/interface/interface.h"
#include "exchange.h"

#include <map>
#include <string>
#include <vector>

/// Properties of the element behind a facet per area, divided by the element's thickness in the reference
/// configuration.
struct FacetMaterial {
  double thickness = 0;     ///< thickness of the element [mm]
  double stiffness = 0;     ///< normal stiffness modulus over thickness [N/mm^3]; infinite if rigid
  double crossing = 0;      ///< time in which sound crosses the element along the facet's normal [s]; 0 if rigid
  bool permeable = false;   ///< true if the material is permeable to the solvent
  double permeability = 0;  ///< hydraulic permeability over thickness [mm^3/(N s)]
  std::map<int, double>
      solutes;  ///< per solute index: porosity x solubility x diffusivity over thickness, plus convection [mm/s]
};

/// The materials behind all facets of both surfaces.
using FacetMaterials = mixture_contact::PerSide<std::vector<FacetMaterial>>;

/// The solvent and the solutes of a model, as fields at a contact. A field that a surface lacks everywhere has an
/// obstacle. `surfaces`: names of the surfaces; `solutes`: names of the solutes.
std::vector<FieldAtContact> fields_at_contact(const FacetMaterials& materials,
                                              const mixture_contact::PerSide<std::string>& surfaces,
                                              const std::vector<std::string>& solutes);

/// True if the material behind a facet of either surface contains a fluid.
bool has_fluid(const FacetMaterials& materials);

/// The longest time in which sound crosses an element behind a facet, along the facet's normal [s]; 0 if all are rigid.
double longest_crossing(const FacetMaterials& materials);
/// True if hard contact would open and close in alternate steps of `dt` [s]. `crossing`: longest_crossing() [s].
///
/// Hard contact stops a node within a step. The trapezoidal rule reverses the velocity v of a node at rest, and the
/// force of its inertia alternates by 4 m v/dt = 2 rho h v/dt per area, with half the mass of an element of thickness
/// h. The wave in the body carries rho c v. A node therefore stays in contact if c dt > 2 h.
inline bool would_rebound(double crossing, double dt) { return dt < 2 * crossing; }

/// Sets the properties of a mesh from the materials behind its facets.
void set_materials(mixture_contact::SurfaceMesh& mesh, const std::vector<FacetMaterial>& materials,
                   const mixture_contact::Effects& effects);

/// Sets the present materials in the contact core, for its automatic penalties.
void update_materials(mixture_contact::ContactInterface& core, const FacetMaterials& materials);

/// The solute index of a field in the order of Effects; -1 for the solvent, also if only friction reads its pressure.
int solute_of(const mixture_contact::Effects& effects, int field);
/// The solute index of each exchanged field; -1 for the solvent.
std::vector<int> exchanged_solutes(const mixture_contact::Effects& effects);
