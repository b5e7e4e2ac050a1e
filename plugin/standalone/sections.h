/// The sections of a model file, each read into its part of the model, and what they share.
#pragma once

#include "model.h"
#include "xml_tag.h"

namespace standalone {

void read_globals(const Tag& section, Model& model);
void read_materials(const Tag& section, Model& model);
void read_mesh(const Tag& section, Model& model);
void read_mesh_domains(const Tag& section, Model& model);
void read_conditions(const Tag& section, Model& model);
void read_rigid(const Tag& section, Model& model);
void read_loads(const Tag& section, Model& model);
void read_contacts(const Tag& section, Model& model);

/// The index of the load curve of the attribute lc, which must exist; -1 if there is none.
int read_curve(const Tag& tag, const Model& model);
/// Takes a number with its load curve.
Read into(Parameter& value, const Model& model);

/// The names in a map, to say what is allowed.
template <class T>
std::string names_of(const std::map<std::string, T>& known) {
  std::vector<std::string> names;
  for (const auto& pair : known) names.push_back(pair.first);
  return listed(names);
}
/// The value of a map under the name that an attribute gives; fails with the known names.
template <class T>
const T& named(const Tag& tag, const char* attribute, const std::map<std::string, T>& known) {
  const std::string name = tag.attribute(attribute);
  const auto entry = known.find(name);
  if (entry != known.end()) return entry->second;
  tag.fail(std::string(attribute) + " \"" + name + "\" does not exist; there is " + names_of(known));
}

}  // namespace standalone
