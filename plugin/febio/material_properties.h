/// What the contact needs to know of the material behind a facet, read from FEBio without touching its state.
#pragma once

#include <FECore/FESurface.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

class FEModel;

/// Properties of the element behind a facet, per area and over the element's thickness in the reference configuration.
struct FacetMaterial {
  double stiffness = 0;     ///< normal stiffness over thickness [N/mm^3]; infinite if rigid
  bool permeable = false;   ///< whether the solvent can pass
  double permeability = 0;  ///< hydraulic permeability over thickness [mm^3/(N s)]
  std::map<int, double>
      solutes;  ///< solute index -> porosity x solubility x diffusivity over thickness, plus convection [mm/s]
};

/// Reads the material behind a facet; a sentence on what is wrong in `problem` and empty where the material is not one
/// that contact can act on. Works on a copy of the material point, so the element's deformation and stress stay as they
/// are.
std::optional<FacetMaterial> facet_material(FEModel& fem, FESurface& surface, FESurfaceElement& facet,
                                            std::string& problem);

/// Names of the model's solutes, in the order of their concentrations.
std::vector<std::string> solute_names(FEModel& fem);
