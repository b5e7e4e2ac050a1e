/// Measured times of a contact, by task and by effect.
#pragma once

#include "base/patch.h"

#include <array>
#include <chrono>
#include <mutex>
#include <optional>
#include <utility>

namespace mixture_contact {

/// The tasks of a contact whose times are measured.
enum class Task {
  search,        ///< search for facets that face each other, and projection
  residual,      ///< residual of the virtual work (2.5)
  stiffness,     ///< contact status, linearisation, matrix profile and tangent (2.6)
  augmentation,  ///< convergence tests, gaps and multipliers
  output         ///< values for plot and log files
};
inline constexpr std::array<Task, 5> all_tasks{Task::search, Task::residual, Task::stiffness, Task::augmentation,
                                               Task::output};

/// Times of one task, by effect [s].
struct TimingBreakdown {
  double shared = 0;    ///< work for all effects: search, geometry, status
  double traction = 0;  ///< work for the traction only
  double friction = 0;  ///< work for friction only
  VectorXd fields;      ///< work for each exchanged scalar field only, in the order of Effects
  double host = 0;      ///< part of all these times that the host spends on residuals, profile and matrices

  explicit TimingBreakdown(Index count = 0) : fields(VectorXd::Zero(count)) {}
  double total() const { return shared + traction + friction + fields.sum(); }
  /// The time to which the equations of a patch count: that of its field, else of the traction. A field beyond the
  /// exchanged ones is the pressure that only friction reads; it counts as friction.
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

/// Measures lap times.
class Stopwatch {
 public:
  /// Seconds since the last lap, or since construction.
  double lap() {
    const auto now = Clock::now();
    const std::chrono::duration<double> passed = now - std::exchange(last_, now);
    return passed.count();
  }
  /// Seconds since the last lap, or since construction; does not begin a new lap.
  double peek() const { return Stopwatch(*this).lap(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

/// Times by task [s].
class Timings {
 public:
  explicit Timings(Index fields = 0) { spent_.fill(TimingBreakdown(fields)); }

  TimingBreakdown& operator[](Task task) { return spent_.at(static_cast<std::size_t>(task)); }
  const TimingBreakdown& operator[](Task task) const { return spent_.at(static_cast<std::size_t>(task)); }

  /// The sum of the times of all tasks.
  TimingBreakdown sum() const {
    TimingBreakdown sum(spent_.front().fields.size());
    for (const TimingBreakdown& each : spent_) sum += each;
    return sum;
  }

 private:
  std::array<TimingBreakdown, all_tasks.size()> spent_;
};

/// Times that several threads spend on single effects [s], until a TaskClock takes them over.
class EffectTimings {
 public:
  explicit EffectTimings(Index fields) : spent_(fields) {}

  void add(const TimingBreakdown& spent) {
    const std::scoped_lock lock(mutex_);
    spent_ += spent;
  }
  /// The times added since the last call.
  TimingBreakdown take() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(spent_, TimingBreakdown(spent_.fields.size()));
  }

 private:
  std::mutex mutex_;
  TimingBreakdown spent_;
};

/// The number of items that a timed item represents when only a sample is timed; 0 for an item that is not timed. Up to
/// `most` items are all timed; of more, at least half of `most` are.
inline Index stands_for(Index number, Index count) {
  constexpr Index most = 256;
  const Index each = 1 + count / most;
  return number % each == 0 ? each : 0;
}

/// Measures the time of the work on one pair of facets, by effect, on any thread. Each call assigns the time since the
/// previous call to an effect.
class ScopedTimer {
 public:
  /// `times`: to which the times are added at destruction. `stands_for`: number of pairs that the timed pair
  /// represents; 0: the pair is not timed.
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

  /// Assigns the time since the last call to no effect: the task's clock counts it as shared.
  void shared() {
    if (running_) running_->lap();
  }
  /// Assigns the time since the last call to the traction.
  void traction() {
    if (running_) running_->spent.traction += running_->lap();
  }
  /// Assigns the time since the last call to friction.
  void friction() {
    if (running_) running_->spent.friction += running_->lap();
  }
  /// Assigns the time since the last call to a field.
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

/// Measures the time of a task from construction to destruction. Time that no effect and no other clock of the task has
/// counted is shared.
class TaskClock {
 public:
  explicit TaskClock(TimingBreakdown& spent) : spent_(spent), before_(spent.total()) {}
  TaskClock(const TaskClock&) = delete;
  TaskClock& operator=(const TaskClock&) = delete;
  TaskClock(TaskClock&&) = delete;
  TaskClock& operator=(TaskClock&&) = delete;
  ~TaskClock() { spent_.shared += watch_.lap() - (spent_.total() - before_); }

  /// Calls a function of the host for the equations of a patch. Its time is added to that of their effect and to that
  /// of the host.
  template <class Call>
  void in_host(const Patch& rows, const Call& call) {
    Stopwatch watch;
    call();
    const double seconds = watch.lap();
    spent_.of(rows) += seconds;
    spent_.host += seconds;
  }
  /// Calls a function of the host for all effects. Its time is added to that of the host.
  template <class Call>
  void in_host(const Call& call) {
    Stopwatch watch;
    call();
    spent_.host += watch.lap();
  }
  /// Takes over the times of effects measured on several threads. `threads`: number of threads that ran at the same
  /// time.
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
