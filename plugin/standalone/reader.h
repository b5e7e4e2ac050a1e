/// Reads models in the subset of FEBio XML 4.0 that this engine supports.
#pragma once

#include "model.h"
#include "xml_tag.h"

namespace standalone {

/// Reads a .feb file. Throws InputError with tag and line if anything is malformed, inconsistent or not supported.
Model read_model(const std::string& path);

// The next functions each read a section of the file into the model.
void read_globals(const Tag& section, Model& model);
void read_materials(const Tag& section, Model& model);
void read_mesh(const Tag& section, Model& model);
void read_mesh_domains(const Tag& section, Model& model);
void read_boundary(const Tag& section, Model& model);
void read_initial(const Tag& section, Model& model);
void read_rigid(const Tag& section, Model& model);
void read_loads(const Tag& section, Model& model);
void read_contacts(const Tag& section, Model& model);

/// The index of the load curve in the attribute lc; fails if it does not exist; -1 without the attribute.
int read_curve(const Tag& tag, const Model& model);
/// A number with its load curve.
Parameter read_parameter(const Tag& tag, const Model& model);

/// The entry of a map whose name is the value of an attribute. If there is no such entry, it fails with the list of
/// known names.
template <class T>
const T& named(const Tag& tag, const char* attribute, const std::map<std::string, T>& known) {
  const std::string name = tag.attribute(attribute);
  const auto entry = known.find(name);
  if (entry != known.end()) return entry->second;
  std::vector<std::string> names;
  for (const auto& pair : known) names.push_back(pair.first);
  tag.fail(std::string(attribute) + " \"" + name + "\" does not exist; there is " + listed(names));
}

}  // namespace standalone
