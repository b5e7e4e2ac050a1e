#include "sections.h"

#include <cmath>

#include <set>

namespace standalone {
namespace {

double in_range(const Tag& tag, double least, double below, const char* allowed) {
  const double value = tag.number();
  if (!std::isfinite(value) || value < least || value >= below) tag.fail("the value must be " + std::string(allowed));
  return value;
}

double positive(const Tag& tag) {
  const double value = tag.number();
  if (value <= 0) tag.fail("the value must be positive");
  return value;
}

/// A tag of one supported type whose only parameter is a number.
Tag constant(const Tag& parent, const char* name, const char* type, std::initializer_list<const char*> children) {
  const Tag tag = parent.child(name);
  tag.allow_attributes({"type"});
  if (tag.attribute("type") != type) tag.fail("only the type \"" + std::string(type) + "\" is supported");
  tag.allow_children(children);
  return tag;
}

void read_solid(const Tag& tag, Material& material) {
  material.modulus = positive(tag.child("E"));
  material.poisson = in_range(tag.child("v"), -0.999, 0.5, "more than -1 and less than 0.5");
}

Solute read_solute(const Tag& tag, const Model& model) {
  tag.allow_attributes({"sol"});
  tag.allow_children({"diffusivity", "solubility"});
  Solute solute;
  solute.index = tag.integer_attribute("sol") - 1;
  if (solute.index >= model.solutes) {
    tag.fail("solute " + std::to_string(solute.index + 1) + " does not exist; <Globals> has " +
             std::to_string(model.solutes));
  }
  const Tag diffusivity = constant(tag, "diffusivity", "diff-const-iso", {"free_diff", "diff"});
  solute.free_diffusivity = positive(diffusivity.child("free_diff"));
  solute.diffusivity = positive(diffusivity.child("diff"));
  if (solute.diffusivity > solute.free_diffusivity) diffusivity.fail("diff must not be larger than free_diff");
  solute.solubility = positive(constant(tag, "solubility", "solub-const", {"solub"}).child("solub"));
  return solute;
}

void read_mixture(const Tag& tag, const Model& model, Material& material) {
  const bool multiphasic = tag.attribute("type") == "multiphasic";
  const bool solute = multiphasic || tag.attribute("type") == "biphasic-solute";
  if (solute) {
    tag.allow_children(
        {"phi0", "fluid_density", "fixed_charge_density", "solid", "permeability", "osmotic_coefficient", "solute"});
    const std::string module = multiphasic ? "multiphasic" : "solute";
    if (model.control.module != module) tag.fail("this material needs the module \"" + module + "\"");
    if (const auto charge = tag.find("fixed_charge_density"); charge && charge->number() != 0)
      charge->fail("charged mixtures are not supported: the value must be 0");
    if (model.gas_constant <= 0 || model.temperature <= 0)
      tag.fail("positive constants R and T are missing in <Globals>");
  } else {
    tag.allow_children({"phi0", "fluid_density", "solid", "permeability"});
  }
  material.porous = true;
  material.solid_fraction = in_range(tag.child("phi0"), 0.0, 1.0, "at least 0 and less than 1");
  read_solid(constant(tag, "solid", "neo-Hookean", {"density", "E", "v"}), material);
  material.permeability = positive(constant(tag, "permeability", "perm-const-iso", {"perm"}).child("perm"));
  if (!solute) return;
  material.osmotic = constant(tag, "osmotic_coefficient", "osm-coef-const", {"osmcoef"}).child("osmcoef").number();
  material.solutes.push_back(read_solute(tag.child("solute"), model));
}

Material read_material(const Tag& tag, const Model& model) {
  tag.allow_attributes({"id", "name", "type"});
  const std::string type = tag.attribute("type");
  Material material;
  material.name = tag.attribute("name");
  if (type == "neo-Hookean") {
    tag.allow_children({"density", "E", "v"});
    read_solid(tag, material);
  } else if (type == "rigid body") {
    tag.allow_children({"density", "center_of_mass", "E", "v"});
    material.rigid = true;
  } else if (type == "biphasic" || type == "biphasic-solute" || type == "multiphasic") {
    read_mixture(tag, model, material);
  } else {
    tag.fail(
        "the type \"" + type +
        R"(" is not supported; allowed: "neo-Hookean", "rigid body", "biphasic", "biphasic-solute", "multiphasic")");
  }
  return material;
}

}  // namespace

void read_globals(const Tag& section, Model& model) {
  section.allow_children({"Constants", "Solutes"});
  if (const auto constants = section.find("Constants")) {
    constants->allow_children({"R", "T", "Fc"});
    if (const auto tag = constants->find("R")) model.gas_constant = tag->number();
    if (const auto tag = constants->find("T")) model.temperature = tag->number();
  }
  const auto solutes = section.find("Solutes");
  if (!solutes) return;
  solutes->allow_children({"solute"});
  for (const Tag& tag : solutes->children()) {
    tag.allow_children({"charge_number", "molar_mass", "density"});
    if (tag.integer_attribute("id") != ++model.solutes) tag.fail("ids must count up from 1");
    if (const auto name = tag.find_attribute("name")) model.solute_names[model.solutes - 1] = *name;
    if (model.solutes > 100) tag.fail("there may be up to 100 solutes");
    if (const auto charge = tag.find("charge_number")) {
      if (charge->number() != 0) charge->fail("charged solutes are not supported");
    }
  }
}

void read_materials(const Tag& section, Model& model) {
  section.allow_children({"material"});
  std::set<std::string> names;
  for (const Tag& tag : section.children()) {
    model.materials.push_back(read_material(tag, model));
    if (!names.insert(model.materials.back().name).second) tag.fail("there are two materials of this name");
  }
}

}  // namespace standalone
