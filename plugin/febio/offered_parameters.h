/// The parameters of a contact among those that FEBio reads.
#pragma once

#include "host/contact_parameters.h"

#include <FECore/FECoreBase.h>
#include <FECore/FEModel.h>
#include <FECore/units.h>

#include <string>
#include <vector>

inline const char* unit_of(Unit unit) {
  switch (unit) {
    case Unit::length:
      return UNIT_LENGTH;
    case Unit::pressure:
      return UNIT_PRESSURE;
    case Unit::concentration:
      return UNIT_CONCENTRATION;
    case Unit::none:
      break;
  }
  return UNIT_NONE;
}

/// Adds a parameter to its group, and hides it if FEBio Studio does not offer it.
template <class Value>
void offer_parameter(FEParamContainer& owner, const ParameterTag& tag, Value& value) {
  owner.BeginParameterGroup(heading(tag.group));
  FEParam* const parameter = owner.AddParameter(value, tag.name);
  owner.EndParameterGroup();
  if (heading(tag.group) == nullptr) parameter->SetFlags(parameter->GetFlags() | FE_PARAM_HIDDEN);
  parameter->setLongName(tag.long_name)->setUnits(unit_of(tag.unit));
  parameter->SetWatchVariable(tag.given);
  if (tag.choices != nullptr) parameter->setEnums(tag.choices);
}

/// Notes the parameters that load curves change; for_each(take) calls take(tag, value) for each. Returns the faults
/// with these curves, one sentence each.
template <class ForEach>
std::vector<std::string> find_load_curves(FECoreBase& owner, const ForEach& for_each) {
  std::vector<std::string> wrong;
  for_each([&](const ParameterTag& tag, auto& value) {
    const bool varies = owner.GetFEModel()->GetLoadController(owner.FindParameterFromData(&value)) != nullptr;
    if (tag.varies != nullptr) *tag.varies = varies;
    const std::string complaint = varies ? load_curve_complaint(tag) : "";
    if (!complaint.empty()) wrong.push_back(complaint);
  });
  return wrong;
}
