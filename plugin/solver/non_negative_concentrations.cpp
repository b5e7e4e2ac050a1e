#include "non_negative_concentrations.h"

#include "held_values.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace newton {
namespace {

/// Concentrations and reactions below this fraction of the largest one do not change the active set.
constexpr double decisive_part = 1e-6;

}  // namespace

std::vector<Place> NonNegativeConcentrations::negative(Solver& solver) {
  std::vector<Place> places;
  if (solver.reactions_of_clamp() == nullptr) return places;
  const Vectors vectors = solver.vectors();
  for (const int dof : solver.concentrations()) {
    double largest = 0;
    for (int node = 0; node < solver.nodes(); ++node) largest = std::max(largest, std::abs(solver.value({node, dof})));
    for (int node = 0; node < solver.nodes(); ++node) {
      const int n = solver.equation({node, dof});
      if (n >= 0 && at(vectors.total, n) + at(vectors.change, n) < -decisive_part * largest)
        places.push_back({node, dof});
    }
  }
  return places;
}

std::vector<Place> NonNegativeConcentrations::rising(const Solver& solver) const {
  // FEBio's reaction is minus the residual of the node's balance. In FEBio's sign convention, the residual of a solute
  // decreases if solute enters; a positive reaction therefore increases the concentration. Each concentration is freed
  // at most once per step, such that none alternates for ever.
  std::vector<Place> places;
  const std::vector<double>* const reactions = solver.reactions_of_clamp();
  if (reactions == nullptr) return places;
  const auto reaction = [&](Place place) {
    const int code = solver.equation(place);
    return code < 0 ? at(*reactions, prescribed(code)) : 0.0;
  };
  double largest = 0;
  for (const Place place : held_) largest = std::max(largest, std::abs(reaction(place)));
  std::copy_if(held_.begin(), held_.end(), std::back_inserter(places),
               [&](Place place) { return reaction(place) > decisive_part * largest && freed_.count(place) == 0; });
  return places;
}

bool NonNegativeConcentrations::is_settled(Solver& solver) const {
  return negative(solver).empty() && rising(solver).empty();
}

void NonNegativeConcentrations::hold(Solver& solver, Place place) {
  hold_at(solver, place, 0);
  held_.push_back(place);
  if (std::exchange(has_acted_, true)) return;
  solver.log(
      "non_negative_concentrations: the solver clamps negative concentrations to zero. The plugin solves this clamp as "
      "an inequality: such a concentration stays at zero until the balance at its node makes it positive. The log "
      "reports this once in a run.");
}

bool NonNegativeConcentrations::adapt(Solver& solver) {
  const std::vector<Place> to_free = rising(solver);
  const std::vector<Place> to_hold = negative(solver);
  for (const Place place : to_free) {
    release_with_value(solver, place);
    yield(place);
    freed_.insert(place);
  }
  for (const Place place : to_hold) hold(solver, place);
  return !to_free.empty() || !to_hold.empty();
}

bool NonNegativeConcentrations::adapt_before_residual(Solver& solver) {
  if (!held_.empty()) solver.evaluate_residual();  // sets the reactions at prescribed values
  return adapt(solver);
}

bool NonNegativeConcentrations::holds(Place place) const {
  return std::find(held_.begin(), held_.end(), place) != held_.end();
}

void NonNegativeConcentrations::yield(Place place) {
  held_.erase(std::remove(held_.begin(), held_.end(), place), held_.end());
}

void NonNegativeConcentrations::begin_iterations(Solver& solver) {
  release(solver);
  resume(solver);
}

void NonNegativeConcentrations::release(Solver& solver) {
  if (solver.reactions_of_clamp() != nullptr) {
    for (const Place place : held_) release_with_value(solver, place);
    // Concentrations freed in a failed attempt have the value at the start of the step again.
    for (const Place place : freed_) synchronise(solver, place);
  }
  held_.clear();
  freed_.clear();
}

void NonNegativeConcentrations::resume(Solver& solver) {
  for (const Place place : last_) {
    if (solver.equation(place) >= 0 && solver.value(place) == 0) hold(solver, place);
  }
}

void NonNegativeConcentrations::end_step(Solver& solver) {
  last_ = held_;
  for (const Place place : held_) {
    if (solver.reactions_of_clamp() == nullptr || !make_free(solver, place)) continue;
    // The solver has already added the changes of the step to its totals.
    at(solver.vectors().total, solver.equation(place)) = solver.value(place);
  }
  held_.clear();
  freed_.clear();
}

}  // namespace newton
