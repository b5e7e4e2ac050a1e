/// Parallel loops with OpenMP whose results do not depend on the number of threads.
#pragma once

#include "base/indexed_vector.h"

#include <algorithm>
#include <exception>
#include <type_traits>
#include <variant>

namespace mixture_contact {

/// Number of results that in_batches() keeps at a time: sufficient to occupy all threads, and small enough for the
/// cache.
inline constexpr Index batch_size = 512;

/// Number of threads of a parallel loop.
inline int thread_count() {
  int threads = 0;
#ifdef _OPENMP
#pragma omp parallel default(none) reduction(+ : threads)
#endif
  threads += 1;
  return threads;
}

/// Calls body(i, workspace) for each i below `count`, in any order and on several threads, each with its own copy of
/// the workspace. A body may write only to data of index i, and has to leave the workspace unchanged. Rethrows an
/// exception of a body. `together`: number of successive indices that one thread processes.
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

/// Calls body(i) for each i below `count`, in any order and on several threads. A body may write only to data of index
/// i. Rethrows an exception of a body. `together`: number of successive indices that one thread processes.
template <Index together = 8, class Body>
void in_parallel(Index count, const Body& body) {
  in_parallel_with<together>(std::monostate(), count, [&](Index i, std::monostate& /*none*/) { body(i); });
}

/// Calls use(i, make(i)) for each i below `count` on the calling thread, with one result at a time.
template <class Make, class Use>
void one_by_one(Index count, const Make& make, const Use& use) {
  for (Index i = 0; i < count; ++i) {
    auto&& result = make(i);
    use(i, result);
  }
}

/// Computes make(i) for each i below `count` on several threads, a batch at a time. After each batch, calls use(i,
/// result) in ascending order on the calling thread; `use` may therefore run parallel loops itself. in_order() is
/// faster if `use` has little work.
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
