/// The entry points of the plugin for febio4, except GetSDKVersion, and the registration of all classes of the plugin.
#include "ambient_concentration.h"
#include "exports.h"
#include "membrane_values.h"
#include "mixture_contact.h"
#include "output_variables.h"
#include "tied_contact.h"

#include <FECore/FECoreKernel.h>

extern "C" {

MIXCONTACT_EXPORT void GetPluginVersion(int& major, int& minor, int& patch) {
  major = MIXCONTACT_VERSION_MAJOR;
  minor = MIXCONTACT_VERSION_MINOR;
  patch = MIXCONTACT_VERSION_PATCH;
}

MIXCONTACT_EXPORT void PluginInitialize(FECoreKernel& kernel) {
  FECoreKernel::SetInstance(&kernel);
  REGISTER_FECORE_CLASS(FEMixtureContact, "sliding-mixture");
  REGISTER_FECORE_CLASS(FEMixtureTie, "tied-mixture");
  REGISTER_FECORE_CLASS(FEMixtureAmbientConcentration, "mixture_ambient_concentration");
  REGISTER_FECORE_CLASS(FEMixtureSolutePermeance, "mixture_solute_permeance");
  REGISTER_FECORE_CLASS(FEMixtureReflection, "mixture_reflection");
  register_output_variables();
}
}
