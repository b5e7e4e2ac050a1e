#include "search_after_failure.h"

namespace newton {
namespace {

/// FEBio's default tolerance of the line search [-].
constexpr double default_tolerance = 0.9;

}  // namespace

void SearchAfterFailure::rewind(Solver& solver) {
  const Solver::LineSearch search = solver.line_search();
  if (given_ || !search.exists() || !is_needed_()) return;
  given_ = {*search.tolerance, *search.halves_inversions};
  if (*search.tolerance == 0) *search.tolerance = default_tolerance;
  *search.halves_inversions = true;
  record_.acted(Device::search_after_failure);
}

void SearchAfterFailure::let_go(Solver& solver) {
  const Solver::LineSearch search = solver.line_search();
  if (!given_ || !search.exists()) return;
  *search.tolerance = given_->tolerance;
  *search.halves_inversions = given_->halves_inversions;
  given_.reset();
}

}  // namespace newton
