/// Measurements of a contact: its time by task, and its memory. No result depends on it.
#pragma once

#include "base/timings.h"

namespace mixture_contact {

/// The memory that a contact keeps.
struct Memory {
  std::size_t points = 0;  ///< integration points that see the other surface
  std::size_t bytes = 0;   ///< for the points, their facets and nodes, between calls
};

struct Measurements {
  Timings timings;  ///< of all calls so far
  Memory memory;    ///< largest number of bytes that an iteration kept, and the integration points that it had

  explicit Measurements(Index fields) : timings(fields) {}

  /// Times a task. A host also times its calls; times of a contact within them do not count twice.
  TaskClock clock(Task task) { return TaskClock(timings[task]); }
  void note(const Memory& now) {
    if (now.bytes >= memory.bytes) memory = now;
  }
};

}  // namespace mixture_contact
