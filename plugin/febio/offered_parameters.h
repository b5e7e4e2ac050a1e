/// The parameters of a contact among those that FEBio reads.
#pragma once

#include "host/contact_parameters.h"

#include <FECore/FECoreBase.h>
#include <FECore/FEModel.h>
#include <FECore/units.h>

#include <string>

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

/// Adds a parameter to its group; what FEBio Studio does not offer is hidden.
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

/// Notes whether a load curve changes a parameter. Returns what is wrong with that; nothing where it may.
template <class Value>
std::string find_load_curve(FECoreBase& owner, const ParameterTag& tag, Value& value) {
  const bool varies = owner.GetFEModel()->GetLoadController(owner.FindParameterFromData(&value)) != nullptr;
  if (tag.varies != nullptr) *tag.varies = varies;
  return varies ? load_curve_complaint(tag) : "";
}
