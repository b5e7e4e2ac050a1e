/// The devices of the solver in a model: switches of its contacts, counts of their actions, and lines of the log.
#pragma once

#include "contact_in_model.h"
#include "solver/devices.h"

#include <string>
#include <vector>

class FEModel;

class ModelDevices {
 public:
  /// Keeps references; `contacts` are all of the model.
  ModelDevices(FEModel& fem, const std::vector<ContactInModel*>& contacts) : fem_(fem), contacts_(contacts) {}

  /// Whether a device may act at present.
  bool is_on(newton::Device device) const;
  /// The fault of a contact's devices, given those of the others: a sentence, or none.
  std::string complaint(ContactInModel& contact) const;
  /// Logs the active devices at the first step.
  void introduce();
  /// Counts the devices that a new matrix uses.
  void count_matrix(const std::vector<ContactInModel*>& contacts, bool has_operations);
  /// A step has failed. Switches devices off for the next attempt, and on for the one after it.
  void fail_step(bool is_tried_again);
  newton::DeviceRecord& record() { return record_; }

 private:
  newton::DeviceSet chosen() const;

  FEModel& fem_;
  const std::vector<ContactInModel*>& contacts_;
  newton::DeviceRecord record_;
  bool are_introduced_ = false;
};
