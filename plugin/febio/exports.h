/// The attribute of functions that febio4 looks up by name.
#pragma once

#ifdef _WIN32
#define MIXCONTACT_EXPORT __declspec(dllexport)
#else
#define MIXCONTACT_EXPORT __attribute__((visibility("default")))
#endif
