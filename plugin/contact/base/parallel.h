/// Loops that OpenMP's threads share, with results that do not depend on the number of threads.
#pragma once

#include "base/indexed_vector.h"

#include <algorithm>
#include <exception>
#include <type_traits>
#include <variant>

namespace mixture_contact {

/// Results of in_batches() that are kept at once: enough to keep threads busy, few enough for the cache.
inline constexpr Index batch_size = 512;

/// How many threads share a loop.
inline int thread_count() {
  int threads = 0;
#ifdef _OPENMP
#pragma omp parallel default(none) reduction(+ : threads)
#endif
  threads += 1;
  return threads;
}

/// Calls body(i, workspace) for each i below `count`, in any order and on several threads, each of which has a copy of
/// the workspace. A body may write only to the data of i, and leaves the workspace unchanged. Rethrows one of the
/// exceptions that bodies throw. `together`: how many that follow each other are one thread's.
template <Index together = 8, class Workspace, class Body>
void in_parallel_with(const Workspace& workspace, Index count, const Body& body) {
  std::exception_ptr thrown;
#ifdef _OPENMP
#pragma omp parallel default(none) shared(workspace, count, body, thrown) if (count > 1)
#endif
  {
    Workspace own = workspace;
#ifdef _OPENMP
#pragma omp for schedule(static, together)
#endif
    for (Index i = 0; i < count; ++i) {
      try {
        body(i, own);
      } catch (...) {
#ifdef _OPENMP
#pragma omp critical(mixture_contact_thrown)
#endif
        thrown = std::current_exception();
      }
    }
  }
  if (thrown) std::rethrow_exception(thrown);
}

/// Calls body(i) for each i below `count`, in any order and on several threads, which have no workspace. A body may
/// write only to the data of i. Rethrows one of the exceptions that bodies throw. `together`: how many that follow each
/// other are one thread's.
template <Index together = 8, class Body>
void in_parallel(Index count, const Body& body) {
  in_parallel_with<together>(std::monostate(), count, [&](Index i, std::monostate& /*none*/) { body(i); });
}

/// use(i, make(i)) for each i below `count`. No result is kept: the next one uses its memory again.
template <class Make, class Use>
void one_by_one(Index count, const Make& make, const Use& use) {
  for (Index i = 0; i < count; ++i) {
    auto&& result = make(i);
    use(i, result);
  }
}

/// Computes make(i) for each i below `count` on several threads, and hands the results on, use(i, make(i)), in
/// ascending order on the calling thread once many are made: `use` may share its own work among threads. in_order() is
/// faster if it has little work of its own.
template <class Make, class Use>
void in_batches(Index count, const Make& make, const Use& use) {
  using Result = std::decay_t<std::invoke_result_t<const Make&, Index>>;
  if (thread_count() == 1) return one_by_one(count, make, use);
  IndexedVector<Result> results(std::min(count, batch_size));
  for (Index first = 0; first < count; first += batch_size) {
    const Index size = std::min(batch_size, count - first);
    in_parallel(size, [&](Index i) { results[i] = make(first + i); });
    for (Index i = 0; i < size; ++i) use(first + i, results[i]);
  }
}

}  // namespace mixture_contact
