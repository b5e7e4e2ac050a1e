/// The properties <solute_permeance> and <reflection> of a contact: membrane coefficients of one solute.
#pragma once

#include "host/contact_parameters.h"

#include <FECore/FECoreClass.h>

#include <vector>

class FEModel;

/// The permeance of a membrane: <solute_permeance sol="name">P</solute_permeance> for each solute, where sol is the
/// name or id of the solute. The value may follow a load curve (attribute lc).
class FEMixtureSolutePermeance : public FECoreClass {
 public:
  explicit FEMixtureSolutePermeance(FEModel* fem) : FECoreClass(fem) {}

  int solute = 0;    ///< id of the solute in the model file, from 1; 0 if not given
  double value = 0;  ///< permeance P [length/time]

  DECLARE_FECORE_CLASS()
  FECORE_BASE_CLASS(FEMixtureSolutePermeance)
};

/// The reflection coefficient of a membrane: <reflection sol="name">sigma</reflection> for each solute, where sol is
/// the name or id of the solute. The value may follow a load curve (attribute lc).
class FEMixtureReflection : public FECoreClass {
 public:
  explicit FEMixtureReflection(FEModel* fem) : FECoreClass(fem) {}

  int solute = 0;    ///< id of the solute in the model file, from 1; 0 if not given
  double value = 0;  ///< reflection coefficient sigma [-]

  DECLARE_FECORE_CLASS()
  FECORE_BASE_CLASS(FEMixtureReflection)
};

/// All membrane coefficients of a contact with one value per solute.
struct MembraneProperties {
  std::vector<FEMixtureSolutePermeance*> permeances;
  std::vector<FEMixtureReflection*> reflections;
};

/// Sets the parameters of a membrane to the present values of the properties.
void read_membrane(const MembraneProperties& properties, MembraneParameters& membrane);

/// The values of properties, each with its solute.
template <class Property>
std::vector<SoluteValue> solute_values(const std::vector<Property*>& properties) {
  std::vector<SoluteValue> values;
  for (const Property* property : properties) values.push_back({property->solute, property->value});
  return values;
}
