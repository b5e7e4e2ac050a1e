/// <solute_permeance> and <reflection>: the coefficients of a membrane for one solute.
#pragma once

#include "host/contact_parameters.h"

#include <FECore/FECoreClass.h>

#include <vector>

class FEModel;

/// Read as <ambient_concentration> is: <solute_permeance sol="name">P</solute_permeance> per solute, where sol is the
/// solute's name or id. The value follows its load curve (attribute lc).
class FEMixtureSolutePermeance : public FECoreClass {
 public:
  explicit FEMixtureSolutePermeance(FEModel* fem) : FECoreClass(fem) {}

  int solute = 0;    ///< solute id of the model file, 1 and up; 0 if not given
  double value = 0;  ///< P [length/time]

  DECLARE_FECORE_CLASS()
  FECORE_BASE_CLASS(FEMixtureSolutePermeance)
};

/// Read likewise: <reflection sol="name">sigma</reflection>.
class FEMixtureReflection : public FECoreClass {
 public:
  explicit FEMixtureReflection(FEModel* fem) : FECoreClass(fem) {}

  int solute = 0;    ///< as that of the permeance
  double value = 0;  ///< sigma [-]

  DECLARE_FECORE_CLASS()
  FECORE_BASE_CLASS(FEMixtureReflection)
};

/// The values that a model gives a membrane per solute.
struct MembraneProperties {
  std::vector<FEMixtureSolutePermeance*> permeances;
  std::vector<FEMixtureReflection*> reflections;
};

/// Sets the values of a membrane by the model and its load curves.
void read_membrane(const MembraneProperties& properties, MembraneParameters& membrane);

/// The values of properties with a solute each.
template <class Property>
std::vector<SoluteValue> solute_values(const std::vector<Property*>& properties) {
  std::vector<SoluteValue> values;
  for (const Property* property : properties) values.push_back({property->solute, property->value});
  return values;
}
