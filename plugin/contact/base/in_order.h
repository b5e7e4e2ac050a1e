/// Results that threads compute side by side and one thread takes in order.
#pragma once

#include "base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <type_traits>
#include <variant>
#include <vector>

namespace mixture_contact {

/// Results of a loop in groups that follow each other: any thread makes the next group, one thread uses the groups in
/// ascending order. Few groups are held at once, so that a used group is still in the cache, and later groups use its
/// memory again.
template <class Result, class Workspace, class Fill, class Use>
class OrderedResults {
 public:
  /// Keeps references.
  OrderedResults(Index count, int threads, const Result& empty, const Fill& fill, const Use& use)
      : count_(count),
        together_(std::clamp<Index>(count / (least_groups_per_thread * threads), least_together, most_together)),
        groups_((count + together_ - 1) / together_),
        held_(std::min<Index>(groups_, groups_per_thread * threads)),
        results_(held_ * together_, empty),
        made_(indexing::entries(held_)),
        fill_(fill),
        use_(use) {}

  /// The work of the one thread that uses results: it makes some, too, while there are none to use.
  void use_all(Workspace& own) {
    run([&] { return used_ < groups_; }, [&] { return use_next() || make_next(own); });
  }
  /// The work of any other thread.
  void make_all(Workspace& own) {
    run([&] { return next_ < groups_; }, [&] { return make_next(own); });
  }
  /// Rethrows one of the exceptions of threads.
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  /// Results of a group, which one thread makes: neighbours in memory. More take less time to hand over, where there
  /// are groups enough for threads to end together and the results held are small.
  static constexpr Index least_together = 8;
  static constexpr Index most_together = sizeof(Result) <= 256 ? 64 : least_together;
  static constexpr Index least_groups_per_thread = 16;
  static constexpr Index groups_per_thread = 4;

  /// Calls `step` until it returns that no work remains, or until a thread has failed.
  template <class Remains, class Step>
  void run(const Remains& remains, const Step& step) {
    try {
      while (remains() && !failed_) {
        if (!step()) std::this_thread::yield();
      }
    } catch (...) {
      if (!failed_.exchange(true)) thrown_ = std::current_exception();
    }
  }

  /// Makes a group unless all that may be held at once are.
  bool make_next(Workspace& own) {
    Index group = next_;
    do {
      if (group >= groups_ || group >= used_ + held_) return false;
    } while (!next_.compare_exchange_weak(group, group + 1));
    for_each_of(group, [&](Index i, Result& result) { fill_(i, result, own); });
    made_of(group) = group + 1;
    return true;
  }

  /// Uses the next group if it is made.
  bool use_next() {
    const Index group = used_;
    if (made_of(group) != group + 1) return false;
    for_each_of(group, use_);
    used_ = group + 1;
    return true;
  }

  template <class Call>
  void for_each_of(Index group, const Call& call) {
    const Index first = group * together_;
    const Index end = std::min(count_, first + together_);
    for (Index i = first; i < end; ++i) call(i, results_[i % results_.count()]);
  }

  std::atomic<Index>& made_of(Index group) { return at(made_, group % held_); }

  Index count_;
  Index together_;  ///< results of a group
  Index groups_;
  Index held_;  ///< at once
  IndexedVector<Result> results_;
  std::vector<std::atomic<Index>> made_;  ///< the last group made in the place of each, plus one
  std::atomic<Index> next_{0};            ///< to be made
  std::atomic<Index> used_{0};            ///< how many are
  std::atomic<bool> failed_{false};
  std::exception_ptr thrown_;
  const Fill& fill_;
  const Use& use_;
};

/// Has fill(i, result, workspace) fill results for each i below `count` on several threads, and hands them on, use(i,
/// result), in ascending order on the calling thread, while the others continue: sums and calls of a host come in the
/// same order whatever the number of threads. Each thread has a copy of the workspace, and results are first copies of
/// the empty one, then used results, whose memory serves again. `use` runs on one thread.
template <class Workspace, class Result, class Fill, class Use>
void in_order_with(const Workspace& workspace, const Result& empty, Index count, const Fill& fill, const Use& use) {
  const int threads = thread_count();
  if (threads == 1) {
    Workspace own = workspace;
    Result result = empty;
    for (Index i = 0; i < count; ++i) {
      fill(i, result, own);
      use(i, result);
    }
    return;
  }
  OrderedResults<Result, Workspace, Fill, Use> results(count, threads, empty, fill, use);
#ifdef _OPENMP
#pragma omp parallel default(none) shared(results, workspace)
#endif
  {
    Workspace own = workspace;
#ifdef _OPENMP
#pragma omp master
#endif
    results.use_all(own);
    results.make_all(own);
  }
  results.rethrow();
}

/// Calls use(i, make(i)) for each i below `count`: `make` on several threads, `use` in ascending order of i on the
/// calling thread. Each result is a new object; in_order_with() reuses the memory of results.
template <class Make, class Use>
void in_order(Index count, const Make& make, const Use& use) {
  using Result = std::decay_t<std::invoke_result_t<const Make&, Index>>;
  const auto fill = [&](Index i, Result& result, std::monostate& /*none*/) { result = make(i); };
  in_order_with(std::monostate(), Result(), count, fill, use);
}

}  // namespace mixture_contact
