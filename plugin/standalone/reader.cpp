#include "reader.h"

#include "error.h"
#include "sections.h"

#include <set>

namespace standalone {
namespace {

void read_module(const Tag& module, Model& model) {
  module.allow_attributes({"type"});
  module.allow_children({"units"});
  model.control.module = module.attribute("type");
  const std::string& type = model.control.module;
  if (type != "biphasic" && type != "solute" && type != "multiphasic")
    module.fail(R"(the module ")" + type + R"(" is not supported; allowed: "biphasic", "solute", "multiphasic")");
  model.control.clamp = type != "biphasic";
}

/// Every porous material has the solutes' nodal values that it needs, and every element a material.
void check(const Model& model, const Tag& root) {
  for (const Element& element : model.mesh.elements) {
    if (element.material < 0)
      root.fail("element " + std::to_string(element.id) + " has no material: a SolidDomain is missing");
  }
}

}  // namespace

Model read_model(const std::string& path) {
  const XmlFile file(path);
  const Tag root = file.root();
  if (root.name() != "febio_spec") root.fail("this is no FEBio model; the first tag must be <febio_spec>");
  if (root.attribute("version") != "4.0") root.fail("only version \"4.0\" is supported");
  root.allow_children({"Module", "Control", "Globals", "Material", "Mesh", "MeshDomains", "Boundary", "Rigid",
                       "Initial", "Loads", "Contact", "LoadData", "Output"});
  Model model;
  model.file = path;
  read_module(root.child("Module"), model);
  const auto read = [&](const char* name, void (*section)(const Tag&, Model&)) {
    if (const auto tag = root.find(name)) section(*tag, model);
  };
  read("LoadData", read_load_data);
  read_control(root.child("Control"), model);
  read("Globals", read_globals);
  read_materials(root.child("Material"), model);
  read_mesh(root.child("Mesh"), model);
  read_mesh_domains(root.child("MeshDomains"), model);
  read("Boundary", read_boundary);
  read("Rigid", read_rigid);
  read("Initial", read_initial);
  read("Loads", read_loads);
  read("Contact", read_contacts);
  read("Output", read_output);
  check(model, root);
  return model;
}

}  // namespace standalone
