#include "helper.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace newton {

void Helpers::add(std::string name, std::unique_ptr<Helper> helper, Switch is_on) {
  helpers_.push_back({std::move(name), std::move(helper), std::move(is_on)});
}

std::string Helpers::unavailable(const std::string& name) const {
  const auto named = [&](const Switched& switched) { return switched.name == name; };
  const auto found = std::find_if(helpers_.begin(), helpers_.end(), named);
  if (found == helpers_.end()) throw std::invalid_argument("no helper of the solver is named " + name);
  return found->helper->unavailable();
}

template <class Use>
void Helpers::for_each(const Use& use) const {
  if (solver_ == nullptr || !solver_->is_newton()) return;
  for (const Switched& switched : helpers_) {
    if (switched.is_on()) use(*switched.helper);
  }
}

template <class Ask>
bool Helpers::any(const Ask& ask) const {
  bool found = false;
  for_each([&](Helper& helper) { found = found || ask(helper); });
  return found;
}

void Helpers::begin_step() {
  for_each([](Helper& helper) { helper.begin_step(); });
}

void Helpers::begin_iterations() {
  for_each([](Helper& helper) { helper.begin_iterations(); });
}

void Helpers::try_increment(const std::vector<double>& increment) {
  for_each([&](Helper& helper) { helper.try_increment(increment); });
}

bool Helpers::adapt() {
  return any([](Helper& helper) { return helper.adapt(); });
}

bool Helpers::adapt_before_residual() {
  return any([](Helper& helper) { return helper.adapt_before_residual(); });
}

bool Helpers::are_settled() {
  return !any([](const Helper& helper) { return !helper.is_settled(); });
}

bool Helpers::reject() {
  return any([](Helper& helper) { return helper.rejects(); });
}

bool Helpers::will_predict() {
  return any([](const Helper& helper) { return helper.will_predict(); });
}

bool Helpers::predict(const std::function<void()>& arrived) {
  return any([&](Helper& helper) { return helper.predict(arrived); });
}

void Helpers::complete_residual() {
  for_each([](Helper& helper) { helper.complete_residual(); });
}

bool Helpers::multiply_by_matrix() const {
  return any([](const Helper& helper) { return helper.multiplies_by_matrix(); });
}

void Helpers::end_step() {
  for_each([](Helper& helper) { helper.end_step(); });
}

void Helpers::rewind() {
  for_each([](Helper& helper) { helper.rewind(); });
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
