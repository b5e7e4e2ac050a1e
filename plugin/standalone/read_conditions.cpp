#include "sections.h"

#include <algorithm>

namespace standalone {
namespace {

constexpr std::array<const char*, 3> axes{"x", "y", "z"};

int displacement_dof(const Tag& tag) {
  const auto axis = std::find(axes.begin(), axes.end(), tag.text());
  if (axis == axes.end()) tag.fail("\"" + tag.text() + "\" is no displacement; allowed: " + listed(axes));
  return static_cast<int>(axis - axes.begin());
}

int solute_dof(const Tag& tag, const Model& model) {
  for (int k = 0; k < model.solutes; ++k) {
    if (tag.text() == "c" + std::to_string(k + 1)) return concentration_dof(k);
  }
  tag.fail("\"" + tag.text() + "\" is no concentration; there are c1 to c" + std::to_string(model.solutes));
}

void require_absolute(const Tag& condition) {
  const auto relative = condition.find("relative");
  if (relative && relative->flag()) relative->fail("relative values are not supported");
}

void read_zero_displacement(const Tag& tag, const std::vector<int>& nodes, Model& model) {
  tag.allow_children({"x_dof", "y_dof", "z_dof"});
  for (int i = 0; i < 3; ++i) {
    const auto axis = tag.find((std::string(axes[static_cast<std::size_t>(i)]) + "_dof").c_str());
    if (axis && axis->flag()) model.prescribed.push_back({i, nodes, {}, false});
  }
}

Condition read_prescribed(const Tag& tag, const std::vector<int>& nodes, const Model& model) {
  const std::string type = tag.attribute("type");
  if (type == "zero fluid pressure") {
    tag.allow_children({});
    return {pressure_dof, nodes, {}};
  }
  if (type == "zero concentration") {
    tag.allow_children({"c_dof"});
    return {solute_dof(tag.child("c_dof"), model), nodes, {}};
  }
  require_absolute(tag);
  const Parameter value = read_parameter(tag.child("value"), model);
  if (type == "prescribed fluid pressure") {
    tag.allow_children({"value", "relative"});
    return {pressure_dof, nodes, value};
  }
  tag.allow_children({"dof", "value", "relative"});
  if (type == "prescribed displacement") return {displacement_dof(tag.child("dof")), nodes, value};
  if (type == "prescribed concentration") return {solute_dof(tag.child("dof"), model), nodes, value};
  tag.fail("the type \"" + type +
           "\" is not supported; allowed: zero or prescribed displacement, fluid pressure, concentration");
}

std::vector<int> rigid_nodes(const Tag& tag, const Model& model) {
  std::vector<int> nodes;
  for (const Element& element : model.mesh.elements) {
    const Material& material = model.materials[static_cast<std::size_t>(element.material)];
    if (material.rigid && material.name == tag.text())
      nodes.insert(nodes.end(), element.nodes.begin(), element.nodes.end());
  }
  if (nodes.empty()) tag.fail("there is no rigid body \"" + tag.text() + "\" with elements");
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

void read_boundary(const Tag& section, Model& model) {
  section.allow_children({"bc"});
  for (const Tag& tag : section.children()) {
    tag.allow_attributes({"name", "type", "node_set"});
    const std::vector<int>& nodes = named(tag, "node_set", model.mesh.node_sets);
    if (tag.attribute("type") == "zero displacement") {
      read_zero_displacement(tag, nodes, model);
    } else {
      model.prescribed.push_back(read_prescribed(tag, nodes, model));
    }
  }
}

void read_rigid(const Tag& section, Model& model) {
  section.allow_children({"rigid_bc"});
  for (const Tag& tag : section.children()) {
    tag.allow_attributes({"name", "type"});
    const std::vector<int> nodes = rigid_nodes(tag.child("rb"), model);
    const std::string type = tag.attribute("type");
    if (type == "rigid_displacement") {
      tag.allow_children({"rb", "dof", "value", "relative"});
      require_absolute(tag);
      model.prescribed.push_back(
          {displacement_dof(tag.child("dof")), nodes, read_parameter(tag.child("value"), model)});
    } else if (type == "rigid_fixed") {
      tag.allow_children({"rb", "Rx_dof", "Ry_dof", "Rz_dof", "Ru_dof", "Rv_dof", "Rw_dof"});
      for (int i = 0; i < 3; ++i) {
        const auto translation = tag.find((std::string("R") + axes[static_cast<std::size_t>(i)] + "_dof").c_str());
        if (translation && translation->flag()) model.prescribed.push_back({i, nodes, {}});
      }
      for (const char* name : {"Ru_dof", "Rv_dof", "Rw_dof"}) {
        if (!tag.child(name).flag())
          tag.child(name).fail("rigid bodies that turn are not supported: all rotations must be fixed");
      }
    } else {
      tag.fail("the type \"" + type + R"(" is not supported; allowed: "rigid_fixed", "rigid_displacement")");
    }
  }
}

void read_initial(const Tag& section, Model& model) {
  section.allow_children({"ic"});
  for (const Tag& tag : section.children()) {
    tag.allow_attributes({"name", "type", "node_set"});
    tag.allow_children({"dof", "value"});
    const std::vector<int>& nodes = named(tag, "node_set", model.mesh.node_sets);
    const Parameter value{tag.child("value").number(), -1};
    if (tag.attribute("type") == "initial fluid pressure") {
      model.initial.push_back({pressure_dof, nodes, value});
    } else if (tag.attribute("type") == "initial concentration") {
      model.initial.push_back({solute_dof(tag.child("dof"), model), nodes, value});
    } else {
      tag.fail(R"(the type is not supported; allowed: "initial fluid pressure", "initial concentration")");
    }
  }
}

void read_loads(const Tag& section, Model& model) {
  section.allow_children({"surface_load"});
  for (const Tag& tag : section.children()) {
    tag.allow_attributes({"name", "type", "surface"});
    const std::string type = tag.attribute("type");
    if (type != "pressure" && type != "fluidflux") {
      tag.fail("the type \"" + type + R"(" is not supported; allowed: "pressure", "fluidflux")");
    }
    const bool fluid = type == "fluidflux";
    if (fluid) {
      tag.allow_children({"flux", "linear", "mixture"});
      if (tag.child("mixture").flag()) tag.child("mixture").fail("only 0 is supported");
    } else {
      tag.allow_children({"pressure", "linear", "symmetric_stiffness"});
    }
    if (!tag.child("linear").flag())
      tag.child("linear").fail("only loads in the reference configuration (1) are supported");
    const Parameter value = read_parameter(tag.child(fluid ? "flux" : "pressure"), model);
    model.loads.push_back({fluid, named(tag, "surface", model.mesh.surfaces), value});
  }
}

}  // namespace standalone
