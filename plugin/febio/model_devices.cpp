#include "model_devices.h"

#include "solver/splitting.h"

#include <FECore/FEModel.h>
#include <FECore/FESurfacePairConstraint.h>
#include <FECore/log.h>

#include <algorithm>
#include <utility>

namespace {

/// The values of <solver_devices> that contacts and ties of a model set.
std::vector<std::string> given_devices(FEModel& fem) {
  std::vector<std::string> given;
  for (int i = 0; i < fem.SurfacePairConstraints(); ++i) {
    FEParam* const parameter = fem.SurfacePairConstraint(i)->FindParameter("solver_devices");
    if (parameter != nullptr && *parameter->GetWatchVariable()) given.push_back(parameter->value<std::string>());
  }
  return given;
}

}  // namespace

newton::DeviceSet chosen_devices(FEModel& fem) {
  const std::vector<std::string> given = given_devices(fem);
  return newton::named_devices(given.empty() ? ContactParameters().helpers.devices.value : given.front()).set;
}

std::string devices_complaint(FEModel& fem, const Given<std::string>& own) {
  const std::vector<std::string> given = given_devices(fem);
  const bool differs = own.given && std::any_of(given.begin(), given.end(), [&](const std::string& other) {
                         return newton::named_devices(other).set != newton::named_devices(own.value).set;
                       });
  return differs ? "<solver_devices> affects the whole model, and another contact has a different value." : "";
}

bool ModelDevices::is_on(newton::Device device) const {
  const bool is_suspended = record_.is_suspended() && !newton::acts_after_failure(device);
  return !is_suspended && newton::has(chosen_devices(fem_), device);
}

void ModelDevices::introduce() {
  const newton::DeviceSet chosen = chosen_devices(fem_);
  if (std::exchange(are_introduced_, true) || chosen.all()) return;
  feLogEx(&fem_, "\nsliding-mixture: active devices of the solver: %s.\n", newton::names(chosen).c_str());
}

void ModelDevices::count_matrix(const std::vector<ContactInModel*>& contacts, bool has_operations) {
  using newton::Device;
  const auto any = [&](const auto& has) { return std::any_of(contacts.begin(), contacts.end(), has); };
  if (any([](const ContactInModel* contact) { return contact->assembly().has_unknown_loads(); }))
    record_.acted(Device::loads_as_unknowns);
  if (has_operations) record_.acted(Device::row_operations);
  if (any([](const ContactInModel* contact) { return !contact->assembly().beside_matrix().empty(); }))
    record_.acted(Device::deferred_coupling);
}

void ModelDevices::fail_step(bool is_tried_again) {
  if (record_.is_suspended()) return record_.resume();
  if (!is_tried_again || chosen_devices(fem_).none() || !record_.suspend()) return;
  feLogEx(
      &fem_,
      "\nsliding-mixture: a step has failed. FEBio repeats it without the devices of the solver. The log reports this "
      "once in a run.\n");
}
