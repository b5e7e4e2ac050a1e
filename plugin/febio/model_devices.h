/// The devices of the solver in a model: the switches of its contacts, the counts of actions, and lines for the log.
#pragma once

#include "contact_in_model.h"
#include "solver/devices.h"

#include <string>
#include <vector>

class FEModel;

/// The devices that the contacts and ties of a model allow.
newton::DeviceSet chosen_devices(FEModel& fem);
/// A fault of the <solver_devices> of a contact or tie, `own`, in combination with those of all others, as a sentence;
/// empty if there is none.
std::string devices_complaint(FEModel& fem, const Given<std::string>& own);

/// Decides which devices may act, and counts their actions.
class ModelDevices {
 public:
  /// Keeps a reference.
  explicit ModelDevices(FEModel& fem) : fem_(fem) {}

  /// True if a device may act in the present step.
  bool is_on(newton::Device device) const;
  /// Logs the active devices in the first step.
  void introduce();
  /// Counts the devices that a new matrix uses. `has_operations`: true if the matrix has row operations.
  void count_matrix(const std::vector<ContactInModel*>& contacts, bool has_operations);
  /// Notes that a step has failed: disables all devices for the next attempt, and enables them for the attempt after
  /// that.
  void fail_step(bool is_tried_again);
  newton::DeviceRecord& record() { return record_; }

 private:
  FEModel& fem_;
  newton::DeviceRecord record_;
  bool are_introduced_ = false;
};
