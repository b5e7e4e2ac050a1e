/// The output of a contact: values at the nodes after each step, warnings, and timings at the end of a run.
#pragma once

#include "bound_contact.h"

class ContactOutput {
 public:
  ContactOutput(const BoundContact& contact, ContactSurfaces& surfaces, const ContactLog& log)
      : contact_(contact), surfaces_(surfaces), log_(log) {}

  /// Stores the values after a step that has been solved.
  void store();
  /// Writes the timings at the end of the run.
  void log_timings() const;

 private:
  void warn_of_overlap();

  const BoundContact& contact_;
  ContactSurfaces& surfaces_;
  const ContactLog& log_;
  mixture_contact::Stopwatch run_;  ///< since the contact was read
  bool has_warned_ = false;         ///< of an overlap, in this run
};
