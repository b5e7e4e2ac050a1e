/// The attribute by which febio4 can look up a function by name.
#pragma once

#ifdef _WIN32
#define MIXCONTACT_EXPORT __declspec(dllexport)
#else
#define MIXCONTACT_EXPORT __attribute__((visibility("default")))
#endif
