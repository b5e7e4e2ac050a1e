/// The function that febio4 calls first in a plugin: it returns the SDK version with which the plugin was built. febio4
/// rejects versions other than its own.
#include "exports.h"
#include "running_febio.h"

#include <FECore/version.h>

#include <cstdio>

extern "C" {

/// Returns 0 if the running FEBio does not fit, for any SDK version; febio4 then rejects the plugin.
MIXCONTACT_EXPORT unsigned int GetSDKVersion() {
  const std::string sentence = misfit(MIXCONTACT_FEBIO_RELEASE, running_symbols());
  if (sentence.empty()) return FE_SDK_VERSION;
  std::fprintf(stderr, "%s\n", sentence.c_str());
  return 0;
}
}
