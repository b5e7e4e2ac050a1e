/// Properties of the material behind a facet that the contact requires, read from FEBio without a change of FEBio's
/// state.
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

/// The parts of a material from which its properties are read; null if the material has no such part. They are stored
/// because the casts that find them take longer than reading the properties.
struct MaterialParts {
  FEMaterial* material = nullptr;
  FERigidMaterial* rigid = nullptr;
  /// Elastic material; for a mixture the solid matrix, whose stiffness is the drained one.
  FEElasticMaterial* solid = nullptr;
  FEHydraulicPermeability* permeability = nullptr;
  FESoluteInterface* solutes = nullptr;
};

/// Finds the parts of a material.
MaterialParts parts_of(FEMaterial& material);

/// Reads the materials behind facets.
class MaterialReader {
 public:
  /// The material behind a facet. Empty if contact cannot act on the material; `problem` then contains the reason as a
  /// sentence. It uses a copy of the material point, so that the element's deformation and stress do not change.
  std::optional<FacetMaterial> behind(FEModel& fem, FESurface& surface, FESurfaceElement& facet, std::string& problem);

 private:
  MaterialParts last_;  ///< parts of the last material, which most often is also the next one
};

/// The substitute for the stiffness of rigid bodies in contact with each other [MPa], where no deformable element
/// provides one: E/(1 - nu^2) of a rigid material, which FEBio's own interfaces use as well, but at least the largest
/// modulus of the deformable materials.
double modulus_of_rigid_bodies(FEModel& fem);

/// Names of the model's solutes, in the order of their concentrations.
std::vector<std::string> solute_names(FEModel& fem);
