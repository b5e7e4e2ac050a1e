/// The devices of the solver: numerical methods that save iterations or matrix entries, or prevent failures.
///
/// Each has a name and a switch, and the log counts its actions. A failed step is tried again without devices.
#pragma once

#include "indexing/entries.h"

#include <array>
#include <bitset>
#include <string>
#include <vector>

namespace newton {

enum class Device {
  loads_as_unknowns,            ///< loads at nodes are further unknowns of the matrix
  row_operations,               ///< rows of loads take those of their nodes, so that pivots lie in order
  deferred_coupling,            ///< couplings across the contact stay out of the matrix, and come in by iteration
  kept_matrix,                  ///< a matrix of a quasi-Newton method is reused although contact changes
  active_set_prediction,        ///< nodes open and close as the matrix answers, before the solver solves
  non_negative_concentrations,  ///< clamped concentrations are solved as an inequality
  line_search_guard,            ///< an increment that the line search cut short is taken as a whole
  residual_floor,               ///< a residual that rounding makes of stiff contact counts as none
  predictor                     ///< a step begins at a predicted state
};

inline constexpr std::array device_names{"loads_as_unknowns", "row_operations",        "deferred_coupling",
                                         "kept_matrix",       "active_set_prediction", "non_negative_concentrations",
                                         "line_search_guard", "residual_floor",        "predictor"};

inline const char* name(Device device) { return indexing::at(device_names, static_cast<int>(device)); }

using DeviceSet = std::bitset<device_names.size()>;

inline bool has(const DeviceSet& set, Device device) { return set[static_cast<std::size_t>(device)]; }

/// Devices as a model file names them.
struct NamedDevices {
  DeviceSet set;
  std::vector<std::string> unknown;  ///< words that name none
};
/// Reads "all", "none", or names with commas between them.
NamedDevices named_devices(const std::string& list);
/// The allowed values, in a sentence.
std::string allowed_devices();
/// The names of some devices with commas between them; "none" where there are none.
std::string names(const DeviceSet& set);

/// How often devices have acted, and whether they may at present.
class DeviceRecord {
 public:
  void acted(Device device) { ++indexing::at(counts_, static_cast<int>(device)); }
  /// Suspends all devices until resume(). Returns whether this is the first time.
  bool suspend();
  void resume() { is_suspended_ = false; }
  bool is_suspended() const { return is_suspended_; }
  /// A line on devices that have acted, by name and number; empty if none has.
  std::string summary() const;

 private:
  std::array<int, device_names.size()> counts_{};
  bool is_suspended_ = false;
  bool has_been_suspended_ = false;
};

}  // namespace newton
