/// Parallel loops whose results one thread uses in ascending order.
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

/// The results of a parallel loop in groups of successive indices. Any thread makes the next group; one thread uses the
/// groups in ascending order. The number of groups in memory is limited: a group is used while it is still in the
/// cache, and its memory is reused for later groups.
template <class Result, class Workspace, class Fill, class Use>
class OrderedResults {
 public:
  /// Keeps references to `fill` and `use`.
  OrderedResults(Index count, int threads, const Result& empty, const Fill& fill, const Use& use)
      : count_(count),
        together_(std::clamp<Index>(count / (least_groups_per_thread * threads), least_together, most_together)),
        groups_((count + together_ - 1) / together_),
        held_(std::min<Index>(groups_, groups_per_thread * threads)),
        results_(held_ * together_, empty),
        made_(indexing::entries(held_)),
        fill_(fill),
        use_(use) {}

  /// The loop of the thread that uses the results. It also makes results while none is ready to be used.
  void use_all(Workspace& own) {
    run([&] { return used_ < groups_; }, [&] { return use_next() || make_next(own); });
  }
  /// The loop of any other thread, which makes results.
  void make_all(Workspace& own) {
    run([&] { return next_ < groups_; }, [&] { return make_next(own); });
  }
  /// Rethrows an exception that a thread caught, if any.
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  /// Limits of the number of results in a group, which are neighbours in memory and made by one thread. Large groups
  /// have less overhead, if there are enough of them to balance the threads and their results are small.
  static constexpr Index least_together = 8;
  static constexpr Index most_together = sizeof(Result) <= 256 ? 64 : least_together;
  static constexpr Index least_groups_per_thread = 16;
  static constexpr Index groups_per_thread = 4;

  /// Calls `step` while work remains and no thread has failed; `step` returns false if it found nothing to do.
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

  /// Makes the next group. Returns false if there is none, or if the largest number of groups is in memory.
  bool make_next(Workspace& own) {
    Index group = next_;
    do {
      if (group >= groups_ || group >= used_ + held_) return false;
    } while (!next_.compare_exchange_weak(group, group + 1));
    for_each_of(group, [&](Index i, Result& result) { fill_(i, result, own); });
    made_of(group) = group + 1;
    return true;
  }

  /// Uses the next group. Returns false if it has not been made.
  bool use_next() {
    const Index group = used_;
    if (made_of(group) != group + 1) return false;
    for_each_of(group, use_);
    used_ = group + 1;
    return true;
  }

  /// Calls call(index, result) for each result of a group.
  template <class Call>
  void for_each_of(Index group, const Call& call) {
    const Index first = group * together_;
    const Index end = std::min(count_, first + together_);
    for (Index i = first; i < end; ++i) call(i, results_[i % results_.count()]);
  }

  /// The number of the group made last in the slot of this group, plus one.
  std::atomic<Index>& made_of(Index group) { return at(made_, group % held_); }

  Index count_;
  Index together_;  ///< number of results in a group
  Index groups_;
  Index held_;  ///< largest number of groups in memory
  IndexedVector<Result> results_;
  std::vector<std::atomic<Index>> made_;  ///< per slot in memory: number of the group made last in it, plus one
  std::atomic<Index> next_{0};            ///< next group to be made
  std::atomic<Index> used_{0};            ///< number of groups that have been used
  std::atomic<bool> failed_{false};
  std::exception_ptr thrown_;
  const Fill& fill_;
  const Use& use_;
};

/// Calls fill(i, result, workspace) for each i below `count` on several threads, and use(i, result) in ascending order
/// of i on the calling thread, while the other threads continue. Sums and callbacks of a host therefore have the same
/// order for any number of threads.
///
/// Each thread has its own copy of the workspace. A result is a copy of `empty` or a used earlier result, whose memory
/// is reused.
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
