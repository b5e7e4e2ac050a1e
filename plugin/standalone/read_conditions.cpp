#include "reader.h"

#include <algorithm>
#include <array>

namespace standalone {
namespace {

constexpr std::array<const char*, 3> axes{"x", "y", "z"};

int read_axis(const Tag& tag) { return static_cast<int>(tag.one_of({axes.begin(), axes.end()})); }

int read_concentration(const Tag& tag, const Model& model) {
  for (int k = 0; k < number_of(model.solutes); ++k) {
    if (tag.text() == "c" + std::to_string(k + 1)) return concentration_dof(k);
  }
  tag.fail("\"" + tag.text() + "\" is no concentration; there are c1 to c" + std::to_string(model.solutes.size()));
}

/// Reads flags such as <x_dof>, each of which fixes a displacement of the nodes to zero.
void read_fixed_axes(const Tag& tag, const std::string& prefix, bool fixed, const std::vector<int>& nodes,
                     Model& model) {
  for (int i = 0; i < 3; ++i) {
    const auto flag = tag.find(prefix + at(axes, i) + "_dof");
    if (flag && flag->flag()) model.prescribed.push_back({i, nodes, {}, fixed});
  }
}

/// Reads a condition. `type`: "zero", "prescribed" or "initial", and a field.
Condition read_condition(const Tag& tag, const std::string& type, const Model& model) {
  const bool zero = type.rfind("zero", 0) == 0;
  const std::string field = type.substr(type.find(' ') + 1);
  Condition condition{pressure_dof, named(tag, "node_set", model.mesh.node_sets), {}};
  if (field == "displacement") condition.dof = read_axis(tag.one("dof"));
  if (field == "concentration") condition.dof = read_concentration(tag.one(zero ? "c_dof" : "dof"), model);
  if (!zero) condition.value = read_parameter(tag.one("value"), model);
  if (!zero) tag.must_be("relative", {"0"});
  return condition;
}

std::vector<int> rigid_nodes(const Tag& tag, const Model& model) {
  std::vector<int> nodes;
  for (const Element& element : model.mesh.elements) {
    const Material& material = model.material(element);
    if (material.rigid && material.name == tag.text())
      nodes.insert(nodes.end(), element.nodes.begin(), element.nodes.end());
  }
  if (nodes.empty()) tag.fail("there is no rigid body \"" + tag.text() + "\" with elements");
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

void read_rigid_condition(const Tag& tag, Model& model) {
  const std::vector<int> nodes = rigid_nodes(tag.one("rb"), model);
  if (tag.attribute("type", {"rigid_fixed", "rigid_displacement"}) == "rigid_displacement") {
    model.prescribed.push_back({read_axis(tag.one("dof")), nodes, read_parameter(tag.one("value"), model)});
    tag.must_be("relative", {"0"});
    return;
  }
  read_fixed_axes(tag, "R", false, nodes, model);
  constexpr Range fixed{[](double x) { return x == 1; }, "1; rigid bodies that turn are not supported"};
  for (const char* name : {"Ru_dof", "Rv_dof", "Rw_dof"}) tag.one(name).number(fixed);
}

void read_load(const Tag& tag, Model& model) {
  constexpr Range reference{[](double x) { return x == 1; }, "1, a load in the reference configuration"};
  const bool fluid = tag.attribute("type", {"pressure", "fluidflux"}) == "fluidflux";
  tag.one("linear").number(reference);
  if (fluid) tag.one("mixture").one_of({"0"});
  if (!fluid) tag.ignore({"symmetric_stiffness"});
  model.loads.push_back(
      {fluid, named(tag, "surface", model.mesh.surfaces), read_parameter(tag.one(fluid ? "flux" : "pressure"), model)});
}

}  // namespace

void read_boundary(const Tag& section, Model& model) {
  for (const Tag& tag : section.all("bc")) {
    const std::string type = tag.attribute(
        "type", {"zero displacement", "zero fluid pressure", "zero concentration", "prescribed displacement",
                 "prescribed fluid pressure", "prescribed concentration"});
    if (type == "zero displacement") {
      read_fixed_axes(tag, "", true, named(tag, "node_set", model.mesh.node_sets), model);
    } else {
      model.prescribed.push_back(read_condition(tag, type, model));
    }
  }
}

void read_initial(const Tag& section, Model& model) {
  for (const Tag& tag : section.all("ic")) {
    const std::string type = tag.attribute("type", {"initial fluid pressure", "initial concentration"});
    model.initial.push_back(read_condition(tag, type, model));
    if (model.initial.back().value.curve >= 0) tag.fail("an initial value cannot have a load curve");
  }
}

void read_rigid(const Tag& section, Model& model) {
  for (const Tag& tag : section.all("rigid_bc")) read_rigid_condition(tag, model);
}

void read_loads(const Tag& section, Model& model) {
  for (const Tag& tag : section.all("surface_load")) read_load(tag, model);
}

}  // namespace standalone
