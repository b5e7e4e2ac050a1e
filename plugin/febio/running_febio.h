/// Whether the FEBio that loads the plugin is one that the plugin was built for. febio4 compares a number that releases
/// with different classes share.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

/// A function that FEBio calls by its place in a table, and that the adapter overrides.
struct Hook {
  const char* name;    ///< for people
  const char* symbol;  ///< in FEBio's libraries
  std::size_t place;   ///< in the table that the plugin was compiled with
};

/// The hooks of FESurfacePairConstraint; none but on Linux, where alone the names in the libraries were looked at.
const std::vector<Hook>& hooks();

/// The address of a name in the running FEBio; null if it has none.
using SymbolLookup = std::function<void*(const char* symbol)>;
SymbolLookup running_symbols();

/// Why a plugin that was built for a release ("4.11.0"; empty: not known) does not fit the running FEBio: a sentence;
/// empty if it fits.
std::string misfit(const std::string& built_for, const SymbolLookup& find);
