/// The properties of the material behind a facet that the contact needs, read from FEBio without touching its state.
#pragma once

#include "host/facet_material.h"

#include <FECore/FESurface.h>

#include <optional>
#include <string>
#include <vector>

class FEElasticMaterial;
class FEHydraulicPermeability;
class FEMaterial;
class FEModel;
class FERigidMaterial;
class FESoluteInterface;

/// The part of a material that each property comes from; null if it has none. Casts find them by names, which takes
/// longer than the properties themselves.
struct MaterialParts {
  FEMaterial* material = nullptr;
  FERigidMaterial* rigid = nullptr;
  FEElasticMaterial* solid = nullptr;  ///< of a mixture its matrix, which carries the drained stiffness
  FEHydraulicPermeability* permeability = nullptr;
  FESoluteInterface* solutes = nullptr;
};

MaterialParts parts_of(FEMaterial& material);

/// Reads the materials behind facets.
class MaterialReader {
 public:
  /// Keeps a reference.
  explicit MaterialReader(FEModel& fem) : fem_(fem) {}

  /// The material behind a facet. Empty if contact cannot act on it; `problem` then gives the reason in a sentence.
  /// Works on a copy of the material point, so the element's deformation and stress stay as they are.
  std::optional<FacetMaterial> behind(FESurface& surface, FESurfaceElement& facet, std::string& problem);

 private:
  FEModel& fem_;
  MaterialParts last_;  ///< most facets have that of the one before
};

/// The stiffness of rigid bodies that touch each other, for lack of any element that could be
/// measured: Young's modulus over 1 - nu^2 of a rigid material, which FEBio's own interfaces take, too, but no less
/// than the largest modulus of the deformable materials [MPa].
double modulus_of_rigid_bodies(FEModel& fem);

/// Names of the model's solutes, in the order of their concentrations.
std::vector<std::string> solute_names(FEModel& fem);
