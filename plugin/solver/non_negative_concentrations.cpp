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

std::vector<Place> NonNegativeConcentrations::negative() const {
  std::vector<Place> places;
  if (solver_.reactions_of_clamp() == nullptr) return places;
  const Vectors vectors = solver_.vectors();
  for (const int dof : solver_.concentrations()) {
    double largest = 0;
    for (int node = 0; node < solver_.nodes(); ++node)
      largest = std::max(largest, std::abs(solver_.value({node, dof})));
    for (int node = 0; node < solver_.nodes(); ++node) {
      const int n = solver_.equation({node, dof});
      if (n >= 0 && at(vectors.total, n) + at(vectors.change, n) < -decisive_part * largest)
        places.push_back({node, dof});
    }
  }
  return places;
}

std::vector<Place> NonNegativeConcentrations::rising() const {
  // FEBio's reaction is minus the residual of the node's balance. In FEBio's sign convention, the residual of a solute
  // decreases if solute enters; a positive reaction therefore increases the concentration. Each concentration is freed
  // at most once per step, such that none alternates for ever.
  std::vector<Place> places;
  const std::vector<double>* const reactions = solver_.reactions_of_clamp();
  if (reactions == nullptr) return places;
  const auto reaction = [&](Place place) {
    const int code = solver_.equation(place);
    return code < 0 ? at(*reactions, prescribed(code)) : 0.0;
  };
  double largest = 0;
  for (const Place place : held_) largest = std::max(largest, std::abs(reaction(place)));
  std::copy_if(held_.begin(), held_.end(), std::back_inserter(places),
               [&](Place place) { return reaction(place) > decisive_part * largest && freed_.count(place) == 0; });
  return places;
}

bool NonNegativeConcentrations::is_settled() const { return negative().empty() && rising().empty(); }

void NonNegativeConcentrations::hold(Place place) {
  hold_at(solver_, place, 0);
  held_.push_back(place);
  if (std::exchange(has_acted_, true)) return;
  solver_.log(
      "non_negative_concentrations: the solver clamps negative concentrations to zero. The plugin solves this clamp as "
      "an inequality: such a concentration stays at zero until the balance at its node makes it positive. The log "
      "reports this once in a run.");
}

bool NonNegativeConcentrations::adapt() {
  const std::vector<Place> to_free = rising();
  const std::vector<Place> to_hold = negative();
  for (const Place place : to_free) {
    release_with_value(solver_, place);
    yield(place);
    freed_.insert(place);
  }
  for (const Place place : to_hold) hold(place);
  return !to_free.empty() || !to_hold.empty();
}

bool NonNegativeConcentrations::adapt_before_residual() {
  if (!held_.empty()) solver_.evaluate_residual();  // sets the reactions at prescribed values
  return adapt();
}

bool NonNegativeConcentrations::holds(Place place) const {
  return std::find(held_.begin(), held_.end(), place) != held_.end();
}

void NonNegativeConcentrations::yield(Place place) {
  held_.erase(std::remove(held_.begin(), held_.end(), place), held_.end());
}

void NonNegativeConcentrations::begin_iterations() {
  release();
  resume();
}

void NonNegativeConcentrations::release() {
  if (solver_.reactions_of_clamp() != nullptr) {
    for (const Place place : held_) release_with_value(solver_, place);
    // Concentrations freed in a failed attempt have the value at the start of the step again.
    for (const Place place : freed_) synchronise(solver_, place);
  }
  held_.clear();
  freed_.clear();
}

void NonNegativeConcentrations::resume() {
  for (const Place place : last_) {
    if (solver_.equation(place) >= 0 && solver_.value(place) == 0) hold(place);
  }
}

void NonNegativeConcentrations::end_step() {
  last_ = held_;
  for (const Place place : held_) {
    if (solver_.reactions_of_clamp() == nullptr || !make_free(solver_, place)) continue;
    // The solver has already added the changes of the step to its totals.
    at(solver_.vectors().total, solver_.equation(place)) = solver_.value(place);
  }
  held_.clear();
  freed_.clear();
}

}  // namespace newton
