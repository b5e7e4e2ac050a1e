#include "reader.h"

#include <algorithm>

namespace standalone {
namespace {

constexpr Range poisson{[](double x) { return x >= -0.999 && x < 0.5; }, "more than -1 and less than 0.5"};
constexpr Range fraction{[](double x) { return x >= 0 && x < 1; }, "at least 0 and less than 1"};
constexpr Range uncharged{[](double x) { return x == 0; }, "0; charges are not supported"};

/// A property of a material; fails unless it has the only supported type.
Tag property(const Tag& tag, const char* name, const char* type) {
  const Tag child = tag.one(name);
  child.attribute("type", {type});
  return child;
}

void read_solid(const Tag& tag, Material& material) {
  tag.ignore({"density"});
  material.modulus = tag.one("E").number(positive);
  material.poisson = tag.one("v").number(poisson);
}

Solute read_solute(const Tag& tag, const Model& model) {
  Solute solute;
  solute.index = tag.integer_attribute("sol") - 1;
  if (solute.index >= number_of(model.solutes)) {
    tag.fail("solute " + std::to_string(solute.index + 1) + " does not exist; <Globals> has " +
             std::to_string(model.solutes.size()));
  }
  const Tag diffusivity = property(tag, "diffusivity", "diff-const-iso");
  solute.free_diffusivity = diffusivity.one("free_diff").number(positive);
  solute.diffusivity = diffusivity.one("diff").number(positive);
  if (solute.diffusivity > solute.free_diffusivity) tag.fail("diff must not be larger than free_diff");
  solute.solubility = property(tag, "solubility", "solub-const").one("solub").number(positive);
  return solute;
}

void read_mixture(const Tag& tag, const std::string& type, const Model& model, Material& material) {
  material.porous = true;
  tag.ignore({"fluid_density"});
  material.solid_fraction = tag.one("phi0").number(fraction);
  read_solid(property(tag, "solid", "neo-Hookean"), material);
  material.permeability = property(tag, "permeability", "perm-const-iso").one("perm").number(positive);
  if (type == "biphasic") return;
  const std::string module = type == "multiphasic" ? "multiphasic" : "solute";
  if (model.control.module != module) tag.fail("this material needs the module \"" + module + "\"");
  if (model.gas_constant <= 0 || model.temperature <= 0)
    tag.fail("positive constants R and T are missing in <Globals>");
  if (const auto charge = tag.find("fixed_charge_density")) charge->number(uncharged);
  material.osmotic = property(tag, "osmotic_coefficient", "osm-coef-const").one("osmcoef").number();
  material.solute = read_solute(tag.one("solute"), model);
}

Material read_material(const Tag& tag, const Model& model) {
  Material material;
  material.name = tag.attribute("name");
  tag.find_attribute("id");
  const std::string type = tag.attribute("type",
                                         {"neo-Hookean", "rigid body", "biphasic", "biphasic-solute", "multiphasic"});
  material.rigid = type == "rigid body";
  if (material.rigid) {
    tag.ignore({"density", "center_of_mass", "E", "v"});
  } else if (type == "neo-Hookean") {
    read_solid(tag, material);
  } else {
    read_mixture(tag, type, model, material);
  }
  return material;
}

void read_solute_of_model(const Tag& tag, Model& model) {
  model.solutes.push_back(tag.find_attribute("name").value_or(""));
  if (tag.integer_attribute("id") != number_of(model.solutes)) tag.fail("ids must count up from 1");
  constexpr std::size_t most = mixture_contact::max_scalar_fields - 1;  // one of the fields is the solvent
  if (model.solutes.size() > most) tag.fail("there may be up to " + std::to_string(most) + " solutes");
  tag.ignore({"molar_mass", "density"});
  if (const auto charge = tag.find("charge_number")) charge->number(uncharged);
}

}  // namespace

void read_globals(const Tag& section, Model& model) {
  if (const auto constants = section.find("Constants")) {
    constants->take("R", model.gas_constant, any);
    constants->take("T", model.temperature, any);
    constants->ignore({"Fc"});
  }
  if (const auto solutes = section.find("Solutes")) {
    for (const Tag& solute : solutes->all("solute")) read_solute_of_model(solute, model);
  }
}

void read_materials(const Tag& section, Model& model) {
  for (const Tag& tag : section.all("material")) {
    Material material = read_material(tag, model);
    const auto same = [&](const Material& other) { return other.name == material.name; };
    if (std::any_of(model.materials.begin(), model.materials.end(), same))
      tag.fail("there are two materials of this name");
    model.materials.push_back(std::move(material));
  }
}

}  // namespace standalone
