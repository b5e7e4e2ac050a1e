#include "running_febio.h"

#include <FECore/FESurfacePairConstraint.h>

#include <cstring>

#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#endif

namespace {

#ifdef _WIN32
constexpr const char* version_symbol = "?getVersionString@febio@@YAPEADXZ";
#else
constexpr const char* version_symbol = "_ZN5febio16getVersionStringEv";
#endif
constexpr const char* table_symbol = "_ZTV23FESurfacePairConstraint";

/// The release series of a version, "4.11" of "4.11.0". Releases of a series have the same classes.
std::string release_series(const std::string& version) {
  return version.substr(0, version.find('.', version.find('.') + 1));
}

/// The release of the running FEBio; empty if it is unknown.
std::string running_release(const SymbolLookup& find) {
  void* function = find(version_symbol);
  return function == nullptr ? "" : reinterpret_cast<char* (*)()>(function)();
}

std::string other_release(const std::string& built_for, const SymbolLookup& find) {
  const std::string running = running_release(find);
  if (built_for.empty() || running.empty() || release_series(running) == release_series(built_for)) return "";
  return "it is release " + running;
}

std::string missing_hook(const SymbolLookup& find) {
  for (const Hook& hook : hooks()) {
    if (find(hook.symbol) == nullptr) return std::string("its classes have no ") + hook.name;
  }
  return "";
}

std::string moved_hook(const SymbolLookup& find) {
  constexpr std::size_t first = 2;  // after the offset to the top of the object, and its type
  const auto* table = static_cast<void* const*>(find(table_symbol));
  if (table == nullptr) return "";
  for (const Hook& hook : hooks()) {
    if (table[first + hook.place] != find(hook.symbol))
      return std::string("its classes have a different position of ") + hook.name;
  }
  return "";
}

/// The position of a virtual function in the table of its class. In the Itanium C++ ABI, a pointer to the function
/// contains the position in bytes (plus one, except on Arm processors).
template <class Function>
std::size_t place_of(Function function) {
  std::size_t words[2] = {0, 0};
  static_assert(sizeof function == sizeof words);
  std::memcpy(words, &function, sizeof words);
  return words[0] / sizeof(void*);
}

}  // namespace

#ifdef __linux__

const std::vector<Hook>& hooks() {
  using Pair = FESurfacePairConstraint;
  using Values = std::vector<double>;
  constexpr auto update = static_cast<void (Pair::*)(const Values&, const Values&)>(&Pair::Update);
  static const std::vector<Hook> all{
      {"InitEquations", "_ZN23FESurfacePairConstraint13InitEquationsEi", place_of(&Pair::InitEquations)},
      {"PrepStep", "_ZN23FESurfacePairConstraint8PrepStepEv", place_of(&Pair::PrepStep)},
      {"Update(Ui, ui)", "_ZN23FESurfacePairConstraint6UpdateERKSt6vectorIdSaIdEES4_", place_of(update)},
      {"UpdateIncrements", "_ZN23FESurfacePairConstraint16UpdateIncrementsERSt6vectorIdSaIdEERKS2_",
       place_of(&Pair::UpdateIncrements)}};
  return all;
}

#else

const std::vector<Hook>& hooks() {
  static const std::vector<Hook> none;
  return none;
}

#endif

#ifdef _WIN32

SymbolLookup running_symbols() {
  return [](const char* symbol) -> void* {
    for (const char* library : {"fecore.dll", "febiolib.dll"}) {
      const HMODULE module = GetModuleHandleA(library);
      if (module == nullptr) continue;
      if (FARPROC found = GetProcAddress(module, symbol)) return reinterpret_cast<void*>(found);
    }
    return nullptr;
  };
}

#else

SymbolLookup running_symbols() {
  return [](const char* symbol) { return dlsym(RTLD_DEFAULT, symbol); };
}

#endif

std::string misfit(const std::string& built_for, const SymbolLookup& find) {
  for (const std::string& reason : {other_release(built_for, find), missing_hook(find), moved_hook(find)}) {
    if (reason.empty()) continue;
    return "FEBioMixtureContact was built for FEBio " + (built_for.empty() ? "of an unknown release" : built_for) +
           " and does not fit the FEBio that loads it: " + reason +
           ". Build the plugin for this FEBio (4.11 or newer), or take a release of the plugin for it.";
  }
  return "";
}
