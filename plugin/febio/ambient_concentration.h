/// <ambient_concentration>: the ambient concentration of one solute, or of the only one.
#pragma once

#include <FECore/FECoreClass.h>

class FEModel;

/// Read as <ambient_concentration>c</ambient_concentration> where there is one solute, and as
/// <ambient_concentration sol="name">c</ambient_concentration> per solute, where sol is the solute's name or id. The
/// value follows its load curve (attribute lc).
class FEMixtureAmbientConcentration : public FECoreClass {
 public:
  explicit FEMixtureAmbientConcentration(FEModel* fem) : FECoreClass(fem) {}

  int solute = 0;    ///< solute id of the model file, 1 and up; 0 if not given
  double value = 0;  ///< effective concentration outside contact [mM]

  DECLARE_FECORE_CLASS()
  FECORE_BASE_CLASS(FEMixtureAmbientConcentration)
};
