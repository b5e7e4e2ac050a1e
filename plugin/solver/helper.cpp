#include "helper.h"

#include "norm.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace newton {

void Helpers::add(Device device, std::unique_ptr<Helper> helper, Switch is_on, DeviceRecord& record) {
  helpers_.push_back({std::move(helper), std::move(is_on), device, &record});
}

void Helpers::add(std::unique_ptr<Helper> helper, Switch is_on) {
  helpers_.push_back({std::move(helper), std::move(is_on), std::nullopt, nullptr});
}

std::string Helpers::unavailable(Device device) const {
  const auto is_it = [&](const Switched& switched) { return switched.device == device; };
  const auto found = std::find_if(helpers_.begin(), helpers_.end(), is_it);
  if (found == helpers_.end()) throw std::invalid_argument(std::string("no helper of the solver is ") + name(device));
  return found->helper->unavailable(*solver_);
}

double Helpers::residual_left() const {
  if (solver_ == nullptr || !solver_->is_newton()) return std::numeric_limits<double>::infinity();
  return std::sqrt(solver_->residual_squares().now) / norm(solver_->vectors().residual);
}

template <class Use>
void Helpers::for_each_switched(const Use& use) const {
  if (solver_ == nullptr || !solver_->is_newton()) return;
  std::for_each(helpers_.begin(), helpers_.end(), use);
}

template <class Use>
void Helpers::for_each(const Use& use) const {
  for_each_switched([&](const Switched& switched) {
    if (switched.is_on()) use(*switched.helper);
  });
}

template <class Ask>
bool Helpers::any(const Ask& ask) const {
  bool found = false;
  for_each([&](Helper& helper) { found = found || ask(helper); });
  return found;
}

template <class Ask>
bool Helpers::any_acts(const Ask& ask) {
  bool found = false;
  for_each_switched([&](const Switched& switched) {
    if (found || !switched.is_on() || !ask(*switched.helper)) return;
    found = true;
    switched.count();
  });
  return found;
}

void Helpers::Switched::count() const {
  if (device) record->acted(*device);
}

void Helpers::begin_step() {
  for_each_switched([&](const Switched& switched) {
    if (switched.is_on() && switched.helper->begin_step(*solver_)) switched.count();
  });
}

void Helpers::begin_iterations() {
  for_each_switched([&](const Switched& switched) {
    if (switched.is_on()) {
      switched.helper->begin_iterations(*solver_);
    } else {
      switched.helper->let_go(*solver_);
    }
  });
}

void Helpers::try_increment(const std::vector<double>& increment) {
  for_each([&](Helper& helper) { helper.try_increment(*solver_, increment); });
}

bool Helpers::adapt() {
  return any_acts([&](Helper& helper) { return helper.adapt(*solver_); });
}

bool Helpers::adapt_before_residual() {
  return any_acts([&](Helper& helper) { return helper.adapt_before_residual(*solver_); });
}

bool Helpers::are_settled() {
  return !any([&](const Helper& helper) { return !helper.is_settled(*solver_); });
}

bool Helpers::reject() {
  return any_acts([&](Helper& helper) { return helper.rejects(*solver_); });
}

bool Helpers::predict(const std::function<void()>& arrived) {
  return any_acts([&](Helper& helper) { return helper.predict(*solver_, arrived); });
}

void Helpers::complete_residual() {
  for_each([&](Helper& helper) { helper.complete_residual(*solver_); });
}

bool Helpers::multiply_by_matrix() const {
  return any([](const Helper& helper) { return helper.multiplies_by_matrix(); });
}

void Helpers::end_step() {
  for_each([&](Helper& helper) { helper.end_step(*solver_); });
}

void Helpers::rewind() {
  for_each([&](Helper& helper) { helper.rewind(*solver_); });
}

bool Helpers::keeps(Place place, bool keep) {
  bool kept = false;
  for_each([&](Helper& helper) {
    if (!helper.holds(place)) return;
    kept = kept || keep;
    if (!keep) helper.yield(place);
  });
  return kept;
}

void Helpers::archive(Archive& archive) {
  for (const Switched& switched : helpers_) switched.helper->archive(archive);
}

}  // namespace newton
