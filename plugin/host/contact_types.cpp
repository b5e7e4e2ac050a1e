#include "contact_types.h"

#include "contact_parameters.h"
#include "tie_parameters.h"

#include <cstring>
#include <iomanip>
#include <sstream>

namespace {

/// A text in JSON; names and headings contain no control characters.
std::string quoted(const char* text) {
  if (text == nullptr) return "null";
  std::ostringstream out;
  out << std::quoted(text);
  return out.str();
}

const char* word_of(Unit unit) {
  switch (unit) {
    case Unit::length:
      return "length";
    case Unit::time:
      return "time";
    case Unit::pressure:
      return "pressure";
    case Unit::concentration:
      return "concentration";
    case Unit::energy_per_area:
      return "energy per area";
    case Unit::none:
      break;
  }
  return "";
}

std::string choices_json(const char* choices) {
  std::string list;
  for (const char* word = choices; word != nullptr && *word != 0; word += std::strlen(word) + 1)
    list += (list.empty() ? "" : ", ") + quoted(word);
  return "[" + list + "]";
}

/// The kind of a parameter, and its default in the form of a model file.
struct Value {
  const char* kind;
  std::string text;
};
Value described(bool value) { return {"switch", value ? "1" : "0"}; }
Value described(int value) { return {"integer", std::to_string(value)}; }
Value described(const std::string& value) { return {"word", value}; }
Value described(double value) {
  std::ostringstream out;
  out << value;
  return {"number", out.str()};
}

std::string parameter_json(const ParameterTag& tag, const Value& value, bool may_follow_curve) {
  return R"({"name": )" + quoted(tag.name) + R"(, "long_name": )" + quoted(tag.long_name) + R"(, "group": )" +
         quoted(heading(tag.group)) + R"(, "unit": )" + quoted(word_of(tag.unit)) + R"(, "kind": )" +
         quoted(value.kind) + R"(, "default": )" + quoted(value.text.c_str()) + R"(, "choices": )" +
         choices_json(tag.choices) + R"(, "curve": )" + (may_follow_curve ? "true" : "false") + "}";
}

/// A list in JSON, made of its entries.
class List {
 public:
  void add(const std::string& part) { text_ += (text_.empty() ? "\n    " : ",\n    ") + part; }
  std::string json() const { return "[" + text_ + "\n  ]"; }

 private:
  std::string text_;
};

std::string sliding_parameters() {
  ContactParameters defaults;
  List list;
  for_each_parameter(defaults, [&](const ParameterTag& tag, const auto& value) {
    list.add(parameter_json(tag, described(value), tag.varies != nullptr));
  });
  list.add(parameter_json(hosts_own::ambient_pressure, described(defaults.ambient.pressure), true));
  for (const ParameterTag& tag : hosts_own::values_per_solute)
    list.add(parameter_json(tag, {"values per solute", "0"}, true));
  return list.json();
}

std::string tie_parameters() {
  TieParameters defaults;
  List list;
  for_each_tie_parameter(defaults, [&](const ParameterTag& tag, const auto& value) {
    list.add(parameter_json(tag, described(value), tag.varies != nullptr));
  });
  list.add(parameter_json(hosts_own::ambient_pressure, described(defaults.ambient.pressure), true));
  list.add(parameter_json(hosts_own::ambient_concentration, {"values per solute", "0"}, true));
  return list.json();
}

}  // namespace

std::string contact_types_json() {
  return "{\n  \"sliding-mixture\": " + sliding_parameters() + ",\n  \"tied-mixture\": " + tie_parameters() + "\n}\n";
}
