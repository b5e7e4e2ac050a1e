/// The entry points that febio4 looks for in a plugin, and the registration of everything it offers.
#include "ambient_concentration.h"
#include "mixture_contact.h"
#include "output_variables.h"

#include <FECore/FECoreKernel.h>
#include <FECore/version.h>

extern "C" {

/// The SDK version this library was built with; febio4 refuses any other.
unsigned int GetSDKVersion() { return FE_SDK_VERSION; }

void GetPluginVersion(int& major, int& minor, int& patch) {
  major = MIXCONTACT_VERSION_MAJOR;
  minor = MIXCONTACT_VERSION_MINOR;
  patch = MIXCONTACT_VERSION_PATCH;
}

void PluginInitialize(FECoreKernel& kernel) {
  FECoreKernel::SetInstance(&kernel);
  REGISTER_FECORE_CLASS(FEMixtureContact, "sliding-mixture");
  REGISTER_FECORE_CLASS(FEMixtureAmbientConcentration, "mixture_ambient_concentration");
  register_output_variables();
}
}
