/// Registration of a contact's parameters with FEBio.
#pragma once

#include "host/contact_parameters.h"

#include <FECore/FECoreBase.h>
#include <FECore/FEModel.h>
#include <FECore/units.h>

#include <string>
#include <vector>

/// FEBio's name of a unit.
inline const char* unit_of(Unit unit) {
  switch (unit) {
    case Unit::length:
      return UNIT_LENGTH;
    case Unit::time:
      return UNIT_TIME;
    case Unit::pressure:
      return UNIT_PRESSURE;
    case Unit::concentration:
      return UNIT_CONCENTRATION;
    case Unit::energy_per_area:
      return UNIT_ENERGY_AREAL_DENSITY;
    case Unit::none:
      break;
  }
  return UNIT_NONE;
}

/// Adds a parameter to its group, and hides it in FEBio Studio if the group has no heading.
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

/// Finds the parameters that have load curves; for_each(take) has to call take(tag, value) for each parameter. Returns
/// the complaints about these curves, one sentence each.
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
