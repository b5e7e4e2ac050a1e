/// The devices of the solver in a model: the switches of its contacts, the counts of actions, and lines for the log.
#pragma once

#include "contact_in_model.h"
#include "solver/devices.h"

#include <string>
#include <vector>

class FEModel;

/// Decides which devices may act, and counts their actions.
class ModelDevices {
 public:
  /// Keeps a reference. `contacts`: all contacts of the model.
  explicit ModelDevices(const std::vector<ContactInModel*>& contacts) : contacts_(contacts) {}

  /// True if a device may act in the present step.
  bool is_on(newton::Device device) const;
  /// The fault of a contact's device settings in combination with those of other contacts, as a sentence; empty if
  /// there is none.
  std::string complaint(ContactInModel& contact) const;
  /// Logs the active devices in the first step.
  void introduce(FEModel& fem);
  /// Counts the devices that a new matrix uses. `has_operations`: true if the matrix has row operations.
  void count_matrix(const std::vector<ContactInModel*>& contacts, bool has_operations);
  /// Notes that a step has failed: disables all devices for the next attempt, and enables them for the attempt after
  /// that.
  void fail_step(FEModel& fem, bool is_tried_again);
  newton::DeviceRecord& record() { return record_; }

 private:
  newton::DeviceSet chosen() const;

  const std::vector<ContactInModel*>& contacts_;
  newton::DeviceRecord record_;
  bool are_introduced_ = false;
};
