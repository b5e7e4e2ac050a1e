/// Output of a contact: nodal values after each step, warnings, and times at the end of a run.
#pragma once

#include "bound_contact.h"

/// Stores and logs the output of a contact.
class ContactOutput {
 public:
  /// Stores the values of a step that has been solved.
  void store(const BoundContact& contact);
  /// Logs the measured times at the end of the run.
  void log_timings(const BoundContact& contact) const;

 private:
  void warn_of_overlap(const BoundContact& contact);

  mixture_contact::Stopwatch run_;  ///< time since the contact was read
  bool has_warned_ = false;         ///< true if an overlap has been reported in this run
};
