/// What febio4 asks a plugin first: the SDK that it was built with. febio4 refuses any other than its own.
#include "exports.h"
#include "running_febio.h"

#include <FECore/version.h>

#include <cstdio>

extern "C" {

/// No SDK where the running FEBio does not fit, whatever its number: febio4 then lets go of the plugin.
MIXCONTACT_EXPORT unsigned int GetSDKVersion() {
  const std::string sentence = misfit(MIXCONTACT_FEBIO_RELEASE, running_symbols());
  if (sentence.empty()) return FE_SDK_VERSION;
  std::fprintf(stderr, "%s\n", sentence.c_str());
  return 0;
}
}
