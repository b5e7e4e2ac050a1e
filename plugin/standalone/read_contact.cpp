#include "sections.h"

#include <algorithm>
#include <cstring>
#include <set>

namespace standalone {
namespace {

/// Takes one of some words, or its number.
Read choice(int& value, const char* words) {
  Names names;
  for (const char* word = words; *word != 0; word += std::strlen(word) + 1) names.push_back(word);
  return [&value, names](const Tag& tag) {
    const auto name = std::find(names.begin(), names.end(), tag.text());
    value = name == names.end() ? tag.integer(0) : static_cast<int>(name - names.begin());
  };
}

template <class T>
Read reader(const ParameterTag& /*tag*/, T& value) {
  return into(value);
}
Read reader(const ParameterTag& tag, int& value) { return tag.choices ? choice(value, tag.choices) : into(value); }

std::vector<Child> table_of(ContactParameters& parameters) {
  // What only febio4 can do is left out of what these may say.
  const std::map<std::string, Names> restricted{{"laugon", {"PENALTY", "AUGLAG", "0", "1"}},
                                                {"extrapolation", {"0"}},
                                                {"node_reloc", {"0"}},
                                                {"flip_primary", {"0"}},
                                                {"flip_secondary", {"0"}}};
  std::vector<Child> table;
  for_each_parameter(parameters, [&](const ParameterTag& parameter, auto& value) {
    const auto restriction = restricted.find(parameter.name);
    const Names allowed = restriction == restricted.end() ? Names{} : restriction->second;
    const auto take = [read = reader(parameter, value), given = parameter.given, allowed](const Tag& tag) {
      if (!allowed.empty()) tag.one_of(allowed);
      read(tag);
      if (given != nullptr) *given = true;
    };
    table.push_back(maybe(parameter.name, take));
  });
  return table;
}

void read_ambient_concentration(const Tag& tag, const Model& model, ContactDefinition& contact) {
  tag.read({"lc", "sol"});
  if (!tag.find_attribute("sol") && model.solutes.size() != 1)
    tag.fail("the attribute sol must say which of the solutes this is for");
  const int solute = tag.find_attribute("sol") ? tag.integer_attribute("sol") : 1;
  if (solute > static_cast<int>(model.solutes.size())) tag.fail("solute " + std::to_string(solute) + " does not exist");
  const Parameter value{tag.number(), read_curve(tag, model)};
  if (!contact.ambient_concentration.emplace(solute - 1, value).second) tag.fail("given twice");
}

void check_surfaces(const Tag& tag, const Model& model, const ContactDefinition& contact) {
  std::set<std::pair<int, int>> faces;
  for (const std::string& name : contact.surfaces) {
    for (const SurfaceFacet& facet : model.mesh.surfaces.at(name)) {
      if (!faces.emplace(facet.element, facet.face).second)
        tag.fail("the surfaces share facets; a surface cannot be in contact with itself");
    }
  }
}

void read_contact(const Tag& tag, Model& model) {
  tag.attribute("type", {"sliding-mixture"});
  ContactDefinition contact;
  contact.surfaces = named(tag, "surface_pair", model.mesh.pairs);
  contact.name = tag.find_attribute("name").value_or(tag.attribute("surface_pair"));
  std::vector<Child> table = table_of(contact.parameters);
  table.push_back(maybe("ambient_pressure", into(contact.ambient_pressure, model)));
  table.push_back(
      each("ambient_concentration", [&](const Tag& bath) { read_ambient_concentration(bath, model, contact); }));
  tag.read({"name", "type", "surface_pair"}, table);
  const std::vector<std::string> wrong = complaints(contact.parameters);
  if (!wrong.empty()) tag.fail(wrong.front());
  for (const std::string& notice : notices(contact.parameters)) model.notices.push_back(contact.name + ": " + notice);
  check_surfaces(tag, model, contact);
  model.contacts.push_back(std::move(contact));
}

}  // namespace

void read_contacts(const Tag& section, Model& model) {
  section.read({}, {each("contact", [&](const Tag& tag) { read_contact(tag, model); })});
}

}  // namespace standalone
