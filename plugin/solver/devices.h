/// The devices of the solver: numerical methods that save iterations or matrix entries, or prevent failures.
///
/// Each device has a name and a switch, and the log reports how often it has acted. A failed step is repeated without
/// devices, except the search after a failure and the constant profile, which changes no result.
#pragma once

#include "indexing/entries.h"

#include <array>
#include <bitset>
#include <string>
#include <vector>

namespace newton {

/// The devices of the solver.
enum class Device {
  loads_as_unknowns,  ///< nodal loads are additional unknowns of the matrix
  row_operations,     ///< multiples of the nodes' rows are added to the rows of their loads, which avoids small pivots
  deferred_coupling,  ///< couplings across the contact are not in the matrix and are included by stationary iteration
  constant_profile,   ///< the profile of the matrix is made once where all contacts are ties
  kept_matrix,        ///< a matrix of a quasi-Newton method is reused although the contact changes
  active_set_prediction,        ///< nodes open and close by solutions with the matrix, before FEBio solves
  non_negative_concentrations,  ///< concentrations that FEBio would clamp to zero are solved as an inequality
  line_search_guard,            ///< an increment that the line search has shortened is repeated with its full length
  residual_floor,               ///< a residual within the rounding of stiff contact counts as zero
  search_after_failure,         ///< a failed step whose bonds soften is repeated with a line search
  predictor                     ///< a step begins at a predicted state
};

inline constexpr std::array device_names{"loads_as_unknowns",
                                         "row_operations",
                                         "deferred_coupling",
                                         "constant_profile",
                                         "kept_matrix",
                                         "active_set_prediction",
                                         "non_negative_concentrations",
                                         "line_search_guard",
                                         "residual_floor",
                                         "search_after_failure",
                                         "predictor"};

inline const char* name(Device device) { return indexing::at(device_names, static_cast<int>(device)); }

/// True for a device that acts in repeated attempts at a step, in which the others do not.
inline bool acts_after_failure(Device device) {
  return device == Device::search_after_failure || device == Device::constant_profile;
}

using DeviceSet = std::bitset<device_names.size()>;

inline bool has(const DeviceSet& set, Device device) { return set[static_cast<std::size_t>(device)]; }

/// Devices as a model file lists them.
struct NamedDevices {
  DeviceSet set;
  std::vector<std::string> unknown;  ///< words that are no name of a device
};
/// Reads "all", "none", or names separated by commas.
NamedDevices named_devices(const std::string& list);
/// A sentence with the allowed names of devices.
std::string allowed_devices();
/// The names of the devices in a set, separated by commas; "none" if it is empty.
std::string names(const DeviceSet& set);

/// Counts how often devices have acted, and suspends them.
class DeviceRecord {
 public:
  /// Counts an action of a device.
  void acted(Device device) { ++indexing::at(counts_, static_cast<int>(device)); }
  /// Suspends all devices until resume(). Returns true at the first call in a run.
  bool suspend();
  void resume() { is_suspended_ = false; }
  bool is_suspended() const { return is_suspended_; }
  /// A line with the names of the devices that have acted and their numbers of actions; empty if none has.
  std::string summary() const;

 private:
  std::array<int, device_names.size()> counts_{};
  bool is_suspended_ = false;
  bool has_been_suspended_ = false;
};

}  // namespace newton
