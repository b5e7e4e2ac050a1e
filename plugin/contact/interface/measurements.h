/// Measured times and memory of a contact. No result depends on them.
#pragma once

#include "base/timings.h"

namespace mixture_contact {

/// The memory of a contact.
struct Memory {
  std::size_t points = 0;  ///< number of integration points
  std::size_t bytes = 0;   ///< memory of the points and of their facets and nodes between calls [bytes]
};

/// Measured times and memory of a contact.
struct Measurements {
  Timings timings;  ///< times of all calls so far
  Memory memory;    ///< memory in the iteration that needed most, with its number of integration points

  explicit Measurements(Index fields) : timings(fields) {}

  /// Starts a clock for a task. A host also measures its own calls; the times of a contact within them are not counted
  /// twice.
  TaskClock clock(Task task) { return TaskClock(timings[task]); }
  /// Keeps `now` if it is the largest memory so far.
  void note(const Memory& now) {
    if (now.bytes >= memory.bytes) memory = now;
  }
};

}  // namespace mixture_contact
