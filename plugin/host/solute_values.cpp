#include "solute_values.h"

#include <algorithm>
#include <cmath>

namespace {

std::string complaint(const std::string& tag, const SoluteValue& value, int solutes, double most) {
  if (value.solute < 0 || value.solute > solutes) {
    return "<" + tag + " sol=\"" + std::to_string(value.solute) +
           "\"> names a solute that the model does not have. It has " + std::to_string(solutes) + ".";
  }
  if (value.solute == 0 && solutes != 1) {
    return "<" + tag + "> needs the attribute sol=\"...\", because the model has " + std::to_string(solutes) +
           " solutes: give the name or the id of one in <Solutes>.";
  }
  if (std::isfinite(value.value) && value.value >= 0 && value.value <= most) return "";
  const std::string allowed = std::isfinite(most) ? "it must lie between 0 and " + std::to_string(most) + "."
                                                  : "it must be zero or positive.";
  return "<" + tag + "> is " + std::to_string(value.value) + "; " + allowed;
}

}  // namespace

std::string complaint(const std::string& tag, const std::vector<SoluteValue>& values, int solutes, double most) {
  for (const SoluteValue& value : values) {
    std::string wrong = complaint(tag, value, solutes, most);
    if (!wrong.empty()) return wrong;
    const auto is_same = [&](const SoluteValue& other) { return other.index() == value.index(); };
    if (std::count_if(values.begin(), values.end(), is_same) > 1)
      return "<" + tag + "> has more than one value for the same solute. Give each solute one value.";
  }
  return "";
}
