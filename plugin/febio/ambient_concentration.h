/// The property <ambient_concentration> of a contact: the ambient concentration of one solute.
#pragma once

#include <FECore/FECoreClass.h>

#include <vector>

class FEModel;

/// A model with one solute has <ambient_concentration>c</ambient_concentration>. A model with several solutes has
/// <ambient_concentration sol="name">c</ambient_concentration> for each, where sol is the name or id of the solute. The
/// value may follow a load curve (attribute lc).
class FEMixtureAmbientConcentration : public FECoreClass {
 public:
  explicit FEMixtureAmbientConcentration(FEModel* fem) : FECoreClass(fem) {}

  int solute = 0;    ///< id of the solute in the model file, from 1; 0 if not given
  double value = 0;  ///< effective concentration at nodes out of contact [mM]

  DECLARE_FECORE_CLASS()
  FECORE_BASE_CLASS(FEMixtureAmbientConcentration)
};

/// The ambient concentrations in a model file.
using AmbientConcentrations = std::vector<FEMixtureAmbientConcentration*>;
