#include "membrane_values.h"

BEGIN_FECORE_CLASS(FEMixtureSolutePermeance, FECoreClass)
  ADD_PARAMETER(solute, "sol", FE_PARAM_ATTRIBUTE, "$(solutes)")->setLongName("solute");
  ADD_PARAMETER(value, "mixture_solute_permeance")->setLongName("membrane permeance");
END_FECORE_CLASS()

BEGIN_FECORE_CLASS(FEMixtureReflection, FECoreClass)
  ADD_PARAMETER(solute, "sol", FE_PARAM_ATTRIBUTE, "$(solutes)")->setLongName("solute");
  ADD_PARAMETER(value, "mixture_reflection")->setLongName("membrane reflection coefficient");
END_FECORE_CLASS()

void read_membrane(const MembraneProperties& properties, MembraneParameters& membrane) {
  membrane.permeance = solute_values(properties.permeances);
  membrane.reflection = solute_values(properties.reflections);
}
