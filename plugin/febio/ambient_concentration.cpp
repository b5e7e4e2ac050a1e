#include "ambient_concentration.h"

BEGIN_FECORE_CLASS(FEMixtureAmbientConcentration, FECoreClass)
  ADD_PARAMETER(solute, "sol", FE_PARAM_ATTRIBUTE, "$(solutes)");
  ADD_PARAMETER(value, "mixture_ambient_concentration");
END_FECORE_CLASS()
