#include "sections.h"

#include <algorithm>

namespace standalone {
namespace {

constexpr Range poisson{[](double x) { return x >= -0.999 && x < 0.5; }, "more than -1 and less than 0.5"};
constexpr Range fraction{[](double x) { return x >= 0 && x < 1; }, "at least 0 and less than 1"};
constexpr Range uncharged{[](double x) { return x == 0; }, "0; charges are not supported"};

void ignored(const Tag& /*tag*/) {}

/// Takes a property of the only type that is supported.
Read property(const char* type, const std::vector<Child>& table) {
  return [=](const Tag& tag) {
    tag.attribute("type", {type});
    tag.read({"type"}, table);
  };
}

std::vector<Child> solid(Material& material) {
  return {maybe("density", ignored), one("E", into(material.modulus, positive)),
          one("v", into(material.poisson, poisson))};
}

void read_solute(const Tag& tag, const Model& model, Material& material) {
  Solute solute;
  solute.index = tag.integer_attribute("sol") - 1;
  if (solute.index >= static_cast<int>(model.solutes.size())) {
    tag.fail("solute " + std::to_string(solute.index + 1) + " does not exist; <Globals> has " +
             std::to_string(model.solutes.size()));
  }
  tag.read({"sol"},
           {one("diffusivity", property("diff-const-iso", {one("free_diff", into(solute.free_diffusivity, positive)),
                                                           one("diff", into(solute.diffusivity, positive))})),
            one("solubility", property("solub-const", {one("solub", into(solute.solubility, positive))}))});
  if (solute.diffusivity > solute.free_diffusivity) tag.fail("diff must not be larger than free_diff");
  material.solute = solute;
}

void read_mixture(const Tag& tag, const Model& model, Material& material) {
  const std::string type = tag.attribute("type");
  std::vector<Child> table{
      maybe("fluid_density", ignored), one("phi0", into(material.solid_fraction, fraction)),
      one("solid", property("neo-Hookean", solid(material))),
      one("permeability", property("perm-const-iso", {one("perm", into(material.permeability, positive))}))};
  if (type != "biphasic") {
    const std::string module = type == "multiphasic" ? "multiphasic" : "solute";
    if (model.control.module != module) tag.fail("this material needs the module \"" + module + "\"");
    if (model.gas_constant <= 0 || model.temperature <= 0)
      tag.fail("positive constants R and T are missing in <Globals>");
    table.push_back(maybe("fixed_charge_density", must_be(uncharged)));
    table.push_back(one("osmotic_coefficient", property("osm-coef-const", {one("osmcoef", into(material.osmotic))})));
    table.push_back(one("solute", [&](const Tag& solute) { read_solute(solute, model, material); }));
  }
  material.porous = true;
  tag.read({"id", "name", "type"}, table);
}

void read_material(const Tag& tag, Model& model) {
  Material material;
  material.name = tag.attribute("name");
  const std::string type = tag.attribute("type",
                                         {"neo-Hookean", "rigid body", "biphasic", "biphasic-solute", "multiphasic"});
  material.rigid = type == "rigid body";
  if (material.rigid) {
    tag.read({"id", "name", "type"},
             {maybe("density", ignored), maybe("center_of_mass", ignored), maybe("E", ignored), maybe("v", ignored)});
  } else if (type == "neo-Hookean") {
    tag.read({"id", "name", "type"}, solid(material));
  } else {
    read_mixture(tag, model, material);
  }
  const auto same = [&](const Material& other) { return other.name == material.name; };
  if (std::any_of(model.materials.begin(), model.materials.end(), same))
    tag.fail("there are two materials of this name");
  model.materials.push_back(std::move(material));
}

void read_solute_of_model(const Tag& tag, Model& model) {
  tag.read({"id", "name"},
           {maybe("charge_number", must_be(uncharged)), maybe("molar_mass", ignored), maybe("density", ignored)});
  model.solutes.push_back(tag.find_attribute("name").value_or(""));
  if (tag.integer_attribute("id") != static_cast<int>(model.solutes.size())) tag.fail("ids must count up from 1");
  constexpr std::size_t most = mixture_contact::max_scalar_fields - 1;  // one more field is the solvent
  if (model.solutes.size() > most) tag.fail("there may be up to " + std::to_string(most) + " solutes");
}

}  // namespace

void read_globals(const Tag& section, Model& model) {
  const auto constants = [&](const Tag& tag) {
    tag.read({}, {maybe("R", into(model.gas_constant)), maybe("T", into(model.temperature)), maybe("Fc", ignored)});
  };
  const auto solute = [&](const Tag& tag) { read_solute_of_model(tag, model); };
  section.read({}, {maybe("Constants", constants),
                    maybe("Solutes", [&](const Tag& tag) { tag.read({}, {each("solute", solute)}); })});
}

void read_materials(const Tag& section, Model& model) {
  section.read({}, {each("material", [&](const Tag& tag) { read_material(tag, model); })});
}

}  // namespace standalone
