#include "sections.h"

#include <algorithm>

namespace standalone {
namespace {

constexpr std::array<const char*, 3> axes{"x", "y", "z"};

Read displacement(int& dof) {
  return [&dof](const Tag& tag) { dof = static_cast<int>(tag.one_of({axes.begin(), axes.end()})); };
}

Read concentration(int& dof, const Model& model) {
  return [&dof, &model](const Tag& tag) {
    for (int k = 0; k < static_cast<int>(model.solutes.size()); ++k) {
      if (tag.text() != "c" + std::to_string(k + 1)) continue;
      dof = concentration_dof(k);
      return;
    }
    tag.fail("\"" + tag.text() + "\" is no concentration; there are c1 to c" + std::to_string(model.solutes.size()));
  };
}

/// Whether values add to those before: they may not.
Child absolute() { return maybe("relative", must_be({"0"})); }

/// Takes flags such as <x_dof>, each of which holds a displacement of the nodes at zero.
std::vector<Child> fixed_axes(const std::string& prefix, bool fixed, const std::vector<int>& nodes, Model& model) {
  std::vector<Child> table;
  for (int i = 0; i < 3; ++i) {
    table.push_back(maybe(prefix + axes[static_cast<std::size_t>(i)] + "_dof", [=, &nodes, &model](const Tag& flag) {
      if (flag.flag()) model.prescribed.push_back({i, nodes, {}, fixed});
    }));
  }
  return table;
}

/// Types are "zero", "prescribed" or "initial", and a field.
void read_condition(const Tag& tag, Model& model) {
  const bool initial = tag.name() == "ic";
  const std::string type = initial ? tag.attribute("type", {"initial fluid pressure", "initial concentration"})
                                   : tag.attribute("type", {"zero displacement", "zero fluid pressure",
                                                            "zero concentration", "prescribed displacement",
                                                            "prescribed fluid pressure", "prescribed concentration"});
  const bool zero = type.rfind("zero", 0) == 0;
  const std::string field = type.substr(type.find(' ') + 1);
  const std::vector<int>& nodes = named(tag, "node_set", model.mesh.node_sets);
  const std::vector<const char*> attributes{"name", "type", "node_set"};
  if (zero && field == "displacement") return tag.read(attributes, fixed_axes("", true, nodes, model));
  Condition condition{pressure_dof, nodes, {}};
  std::vector<Child> table;
  if (initial) {
    table.push_back(one("value", into(condition.value.value)));
  } else if (!zero) {
    table = {one("value", into(condition.value, model)), absolute()};
  }
  if (field == "displacement") table.push_back(one("dof", displacement(condition.dof)));
  if (field == "concentration") table.push_back(one(zero ? "c_dof" : "dof", concentration(condition.dof, model)));
  tag.read(attributes, table);
  (initial ? model.initial : model.prescribed).push_back(std::move(condition));
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
  Condition condition;
  const Child body = one("rb", [&](const Tag& name) { condition.nodes = rigid_nodes(name, model); });
  if (tag.attribute("type", {"rigid_fixed", "rigid_displacement"}) == "rigid_displacement") {
    tag.read({"name", "type"},
             {body, one("dof", displacement(condition.dof)), one("value", into(condition.value, model)), absolute()});
    model.prescribed.push_back(condition);
    return;
  }
  std::vector<Child> table = fixed_axes("R", false, condition.nodes, model);
  table.insert(table.begin(), body);
  constexpr Range fixed{[](double x) { return x == 1; }, "1; rigid bodies that turn are not supported"};
  for (const char* name : {"Ru_dof", "Rv_dof", "Rw_dof"}) table.push_back(one(name, must_be(fixed)));
  tag.read({"name", "type"}, table);
}

void read_load(const Tag& tag, Model& model) {
  constexpr Range reference{[](double x) { return x == 1; }, "1, a load in the reference configuration"};
  const bool fluid = tag.attribute("type", {"pressure", "fluidflux"}) == "fluidflux";
  SurfaceLoad load{fluid, named(tag, "surface", model.mesh.surfaces), {}};
  std::vector<Child> table{one("linear", must_be(reference)),
                           one(fluid ? "flux" : "pressure", into(load.value, model))};
  table.push_back(fluid ? one("mixture", must_be({"0"})) : maybe("symmetric_stiffness", [](const Tag&) {}));
  tag.read({"name", "type", "surface"}, table);
  model.loads.push_back(std::move(load));
}

}  // namespace

void read_conditions(const Tag& section, Model& model) {
  section.read({},
               {each(section.name() == "Initial" ? "ic" : "bc", [&](const Tag& tag) { read_condition(tag, model); })});
}

void read_rigid(const Tag& section, Model& model) {
  section.read({}, {each("rigid_bc", [&](const Tag& tag) { read_rigid_condition(tag, model); })});
}

void read_loads(const Tag& section, Model& model) {
  section.read({}, {each("surface_load", [&](const Tag& tag) { read_load(tag, model); })});
}

}  // namespace standalone
