#include "model_devices.h"

#include "solver/splitting.h"

#include <FECore/FEModel.h>
#include <FECore/log.h>

#include <algorithm>
#include <utility>

namespace {

const Given<std::string>& given_by(ContactInModel* contact) { return contact->bound().parameters().helpers.devices; }

}  // namespace

newton::DeviceSet ModelDevices::chosen() const {
  const auto gives = [](ContactInModel* contact) { return given_by(contact).given; };
  const auto given = std::find_if(contacts_.begin(), contacts_.end(), gives);
  const std::string list = given == contacts_.end() ? ContactParameters().helpers.devices.value
                                                    : given_by(*given).value;
  return newton::named_devices(list).set;
}

bool ModelDevices::is_on(newton::Device device) const {
  const bool is_suspended = record_.is_suspended() && !newton::acts_after_failure(device);
  return !is_suspended && newton::has(chosen(), device);
}

std::string ModelDevices::complaint(ContactInModel& contact) const {
  const Given<std::string>& one = given_by(&contact);
  const bool differs = std::any_of(contacts_.begin(), contacts_.end(), [&](ContactInModel* other) {
    const Given<std::string>& its = given_by(other);
    return one.given && its.given && newton::named_devices(one.value).set != newton::named_devices(its.value).set;
  });
  return differs ? "<solver_devices> affects the whole model, and another contact has a different value." : "";
}

void ModelDevices::introduce(FEModel& fem) {
  if (std::exchange(are_introduced_, true) || chosen().all()) return;
  feLogEx(&fem, "\nsliding-mixture: active devices of the solver: %s.\n", newton::names(chosen()).c_str());
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

void ModelDevices::fail_step(FEModel& fem, bool is_tried_again) {
  if (record_.is_suspended()) return record_.resume();
  if (!is_tried_again || chosen().none() || !record_.suspend()) return;
  feLogEx(
      &fem,
      "\nsliding-mixture: a step has failed. FEBio repeats it without the devices of the solver. The log reports this "
      "once in a run.\n");
}
