#include "host/membrane.h"
#include "host/tie_parameters.h"
#include "reader.h"

#include <algorithm>
#include <cstring>
#include <set>

namespace standalone {
namespace {

void take(const Tag& tag, const ParameterTag& /*parameter*/, std::string& value) { value = tag.text(); }
void take(const Tag& tag, const ParameterTag& /*parameter*/, double& value) { value = tag.number(); }
void take(const Tag& tag, const ParameterTag& /*parameter*/, bool& value) { value = tag.flag(); }
/// Reads one of the words in `parameter.choices`, or its number.
void take(const Tag& tag, const ParameterTag& parameter, int& value) {
  Names names;
  for (const char* word = parameter.choices; word != nullptr && *word != 0; word += std::strlen(word) + 1)
    names.push_back(word);
  const auto name = std::find(names.begin(), names.end(), tag.text());
  value = name == names.end() ? tag.integer() : static_cast<int>(name - names.begin());
}

/// Reads the parameters without load curves. `for_each`: for_each_parameter(), or the function for ties.
template <class ForEach>
void read_parameters(const Tag& tag, ContactParameters& parameters, const ForEach& for_each) {
  for_each(parameters, [&](const ParameterTag& parameter, auto& value) {
    const std::optional<Tag> child = tag.find(parameter.name);
    if (child) take(*child, parameter, value);
    if (child && parameter.given != nullptr) *parameter.given = true;
  });
  // Options that only febio4 supports must have their default values.
  tag.must_be("laugon", {"PENALTY", "AUGLAG", "0", "1"});
  for (const char* name : {"predictor", "node_reloc", "seg_up", "flip_primary", "flip_secondary",
                           "shell_bottom_primary", "shell_bottom_secondary"})
    tag.must_be(name, {"0"});
  const std::vector<std::string> wrong = complaints(parameters);
  if (!wrong.empty()) tag.fail(wrong.front());
}

/// The id of the solute in the attribute sol, by name or id; if the attribute is missing, the only solute of the model.
int solute_of(const Tag& tag, const Model& model) {
  const std::optional<std::string> sol = tag.find_attribute("sol");
  if (!sol && model.solutes.size() != 1) tag.fail("the attribute sol must say which of the solutes this is for");
  if (!sol) return 1;
  const auto named = std::find(model.solutes.begin(), model.solutes.end(), *sol);
  if (named != model.solutes.end()) return static_cast<int>(named - model.solutes.begin()) + 1;
  const int solute = tag.integer_attribute("sol");
  if (solute < 1 || solute > static_cast<int>(model.solutes.size()))
    tag.fail("solute " + std::to_string(solute) + " does not exist");
  return solute;
}

void read_ambient_concentration(const Tag& tag, const Model& model, ContactDefinition& contact) {
  const int solute = solute_of(tag, model);
  if (!contact.ambient_concentration.emplace(solute - 1, read_parameter(tag, model)).second) tag.fail("given twice");
}

std::vector<SoluteValue> read_solute_values(const Tag& contact, const char* name, const Model& model) {
  std::vector<SoluteValue> values;
  for (const Tag& tag : contact.all(name)) values.push_back({solute_of(tag, model), tag.number()});
  return values;
}

void read_membrane(const Tag& tag, const Model& model, MembraneParameters& membrane) {
  membrane.permeance = read_solute_values(tag, "solute_permeance", model);
  membrane.reflection = read_solute_values(tag, "reflection", model);
  membrane.thermal_energy = model.gas_constant * model.temperature;
  const std::vector<std::string> wrong = membrane_complaints(membrane, number_of(model.solutes));
  if (!wrong.empty()) tag.fail(wrong.front());
}

/// True if a contact is a tie.
bool is_tie(const Tag& tag) {
  const std::string type = tag.attribute("type");
  if (type != "sliding-mixture" && type != "tied-mixture")
    tag.fail(
        "the type \"" + type +
        "\" is not supported; allowed: sliding-mixture, tied-mixture. The command `mixcontact convert` makes them of "
        "FEBio's contacts");
  return type == "tied-mixture";
}

void check_surfaces(const Tag& tag, const Model& model, const ContactDefinition& contact) {
  std::set<std::pair<int, int>> faces;
  for (const std::string& name : contact.surfaces) {
    for (const SurfaceFacet& facet : model.mesh.surfaces.at(name)) {
      if (!faces.emplace(facet.element, facet.face).second)
        tag.fail("the surfaces share facets; contact of a body with itself is for febio4");
    }
  }
}

/// Reads the parameters that only sliding contacts have.
void read_sliding(const Tag& tag, Model& model, ContactDefinition& contact) {
  read_parameters(tag, contact.parameters, [](auto&&... given) { for_each_parameter(given...); });
  read_membrane(tag, model, contact.parameters.membrane);
  if (const auto pressure = tag.find("ambient_pressure")) contact.ambient_pressure = read_parameter(*pressure, model);
  for (const Tag& ambient : tag.all("ambient_concentration")) read_ambient_concentration(ambient, model, contact);
  if (contact.parameters.helpers.devices.given)
    model.notices.push_back(contact.name + ": <solver_devices> has no effect: this engine has none of them.");
}

}  // namespace

void read_contacts(const Tag& section, Model& model) {
  for (const Tag& tag : section.all("contact")) {
    ContactDefinition contact;
    const bool ties = is_tie(tag);
    contact.surfaces = named(tag, "surface_pair", model.mesh.pairs);
    contact.name = tag.find_attribute("name").value_or(tag.attribute("surface_pair"));
    if (ties) {
      if (tag.find("max_traction")) tag.fail("ties that break, with <max_traction>, are for febio4");
      read_parameters(tag, contact.parameters, [](auto&&... given) { for_each_lasting_tie_parameter(given...); });
    } else {
      read_sliding(tag, model, contact);
    }
    for (const std::string& notice : notices(contact.parameters)) model.notices.push_back(contact.name + ": " + notice);
    check_surfaces(tag, model, contact);
    (ties ? model.contacts.tied : model.contacts.sliding).push_back(std::move(contact));
  }
}

}  // namespace standalone
