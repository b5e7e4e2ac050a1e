/// The time of a contact: by task and by effect, from clocks around pairs of facets and around whole tasks.
#pragma once

#include "base/patch.h"

#include <array>
#include <chrono>
#include <mutex>
#include <optional>
#include <utility>

namespace mixture_contact {

/// The tasks that a host gives a contact.
enum class Task {
  search,        ///< search for facets that face each other, and projection
  residual,      ///< the virtual work (2.5)
  stiffness,     ///< status, linearisation, matrix profile and tangent (2.6)
  augmentation,  ///< tests of a solution, gaps, and multipliers
  output         ///< values for plot and log
};
inline constexpr std::array<Task, 5> all_tasks{Task::search, Task::residual, Task::stiffness, Task::augmentation,
                                               Task::output};

/// Seconds, by effect and task.
struct TimingBreakdown {
  double shared = 0;    ///< shared by all effects: search, geometry, status
  double traction = 0;  ///< the traction alone
  double friction = 0;  ///< friction alone
  VectorXd fields;      ///< each exchanged scalar field alone, in the order of Effects
  double host = 0;      ///< of all these: the host's own work of taking over residuals, profile and matrices

  explicit TimingBreakdown(Index count = 0) : fields(VectorXd::Zero(count)) {}
  double total() const { return shared + traction + friction + fields.sum(); }
  /// The time of the equations of a patch: one field, or else the traction; or the field a node's pressure acts on.
  double& of(const Patch& rows) {
    if (rows.fields.empty()) return traction;
    return rows.fields.front() < fields.size() ? fields[rows.fields.front()] : friction;
  }

  TimingBreakdown& operator+=(const TimingBreakdown& more) {
    shared += more.shared;
    traction += more.traction;
    friction += more.friction;
    fields += more.fields;
    host += more.host;
    return *this;
  }
};

/// Seconds that pass, lap by lap.
class Stopwatch {
 public:
  /// Seconds since the last lap or the beginning.
  double lap() {
    const auto now = Clock::now();
    const std::chrono::duration<double> passed = now - std::exchange(last_, now);
    return passed.count();
  }
  /// Seconds since the last lap or the beginning, without a new lap.
  double peek() const { return Stopwatch(*this).lap(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

/// Seconds by task.
class Timings {
 public:
  explicit Timings(Index fields = 0) { spent_.fill(TimingBreakdown(fields)); }

  TimingBreakdown& operator[](Task task) { return spent_.at(static_cast<std::size_t>(task)); }
  const TimingBreakdown& operator[](Task task) const { return spent_.at(static_cast<std::size_t>(task)); }

  /// The sum over all tasks.
  TimingBreakdown sum() const {
    TimingBreakdown sum(spent_.front().fields.size());
    for (const TimingBreakdown& each : spent_) sum += each;
    return sum;
  }

 private:
  std::array<TimingBreakdown, all_tasks.size()> spent_;
};

/// Seconds that threads spend on single effects; a clock of the task takes them over.
class EffectTimings {
 public:
  explicit EffectTimings(Index fields) : spent_(fields) {}

  void add(const TimingBreakdown& spent) {
    const std::scoped_lock lock(mutex_);
    spent_ += spent;
  }
  /// The time that has been added since the last call.
  TimingBreakdown take() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(spent_, TimingBreakdown(spent_.fields.size()));
  }

 private:
  std::mutex mutex_;
  TimingBreakdown spent_;
};

/// The number of items that a timed item, given by its number, represents; 0 if another item represents it. All items
/// are timed up to `most`; otherwise at least half of `most` are.
inline Index stands_for(Index number, Index count) {
  constexpr Index most = 256;
  const Index each = 1 + count / most;
  return number % each == 0 ? each : 0;
}

/// Charges the work on one pair of facets to effects, on any thread: each call charges the time since the last.
class ScopedTimer {
 public:
  /// `times`: the charged times; `stands_for`: number of pairs that a timed one represents; 0 is not timed.
  ScopedTimer(EffectTimings& times, Index fields, Index stands_for = 1) : times_(times) {
    if (stands_for > 0) running_.emplace(fields, static_cast<double>(stands_for));
  }
  ScopedTimer(const ScopedTimer&) = delete;
  ScopedTimer& operator=(const ScopedTimer&) = delete;
  ScopedTimer(ScopedTimer&&) = delete;
  ScopedTimer& operator=(ScopedTimer&&) = delete;
  ~ScopedTimer() {
    if (running_) times_.add(running_->spent);
  }

  /// Work for all effects: left to the clock of the task.
  void shared() {
    if (running_) running_->lap();
  }
  void traction() {
    if (running_) running_->spent.traction += running_->lap();
  }
  void friction() {
    if (running_) running_->spent.friction += running_->lap();
  }
  void field(int k) {
    if (running_) running_->spent.fields[k] += running_->lap();
  }

 private:
  struct Running {
    Running(Index fields, double stands_for) : spent(fields), times(stands_for) {}
    double lap() { return times * watch.lap(); }

    TimingBreakdown spent;
    double times;
    Stopwatch watch;
  };
  EffectTimings& times_;
  std::optional<Running> running_;
};

/// Timings a task from construction to destruction. Time not charged meanwhile, to an effect or by another
/// clock of the same task, is shared.
class TaskClock {
 public:
  explicit TaskClock(TimingBreakdown& spent) : spent_(spent), before_(spent.total()) {}
  TaskClock(const TaskClock&) = delete;
  TaskClock& operator=(const TaskClock&) = delete;
  TaskClock(TaskClock&&) = delete;
  TaskClock& operator=(TaskClock&&) = delete;
  ~TaskClock() { spent_.shared += watch_.lap() - (spent_.total() - before_); }

  /// Calls a function of the host on the equations of a patch.
  template <class Call>
  void in_host(const Patch& rows, const Call& call) {
    Stopwatch watch;
    call();
    const double seconds = watch.lap();
    spent_.of(rows) += seconds;
    spent_.host += seconds;
  }
  /// Calls a function of the host on all equations of a patch; its time is the host's, and no effect's.
  template <class Call>
  void in_host(const Call& call) {
    Stopwatch watch;
    call();
    spent_.host += watch.lap();
  }
  /// Takes over the times that threads have charged to effects, `threads` at a time.
  void take(EffectTimings& times, int threads) {
    const TimingBreakdown spent = times.take();
    spent_.traction += spent.traction / threads;
    spent_.friction += spent.friction / threads;
    spent_.fields += spent.fields / threads;
  }

 private:
  TimingBreakdown& spent_;
  double before_;
  Stopwatch watch_;
};

}  // namespace mixture_contact
