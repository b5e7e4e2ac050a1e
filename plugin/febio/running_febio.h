/// Test whether the plugin was built for the FEBio that loads it. febio4 itself compares only a number that releases
/// with different classes share.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

/// A virtual function of FEBio that the plugin overrides and FEBio calls by its position in the virtual table.
struct Hook {
  const char* name;    ///< readable name
  const char* symbol;  ///< symbol in FEBio's libraries
  std::size_t place;   ///< position in the virtual table with which the plugin was compiled
};

/// The overridden functions of FESurfacePairConstraint. Empty on systems other than Linux, whose symbols are not known.
const std::vector<Hook>& hooks();

/// The address of a symbol in the running FEBio; null if there is none.
using SymbolLookup = std::function<void*(const char* symbol)>;
/// Looks up symbols in the libraries that the process has loaded.
SymbolLookup running_symbols();

/// The reason why a plugin that was built for this release ("4.11.0"; empty if unknown) does not fit the running FEBio,
/// as a sentence; empty if it fits.
std::string misfit(const std::string& built_for, const SymbolLookup& find);
