#include "ambient_concentration.h"

BEGIN_FECORE_CLASS(FEMixtureAmbientConcentration, FECoreClass)
  ADD_PARAMETER(solute, "sol", FE_PARAM_ATTRIBUTE, "$(solutes)")->setLongName("solute");
  ADD_PARAMETER(value, "mixture_ambient_concentration")
      ->setLongName("ambient concentration")
      ->setUnits(UNIT_CONCENTRATION);
END_FECORE_CLASS()
