#include "sections.h"

#include <algorithm>
#include <limits>
#include <set>
#include <variant>

namespace standalone {
namespace {

/// A parameter under its name in the file: where its value goes, and the flag that tells that it is given.
struct Slot {
  std::variant<double*, int*, bool*> value;
  bool* given = nullptr;
};

std::map<std::string, Slot> slots(ContactParameters& p) {
  return {{"tolerance", {&p.tolerance}},
          {"traction_tolerance", {&p.traction_tolerance, &p.traction_tolerance_given}},
          {"solvent_tolerance", {&p.solvent_tolerance, &p.solvent_tolerance_given}},
          {"solute_tolerance", {&p.solute_tolerance, &p.solute_tolerance_given}},
          {"gaptol", {&p.gaptol}},
          {"ptol", {&p.ptol}},
          {"ctol", {&p.ctol}},
          {"penalty", {&p.penalty, &p.penalty_given}},
          {"pressure_penalty", {&p.pressure_penalty, &p.pressure_penalty_given}},
          {"concentration_penalty", {&p.concentration_penalty, &p.concentration_penalty_given}},
          {"auto_penalty", {&p.auto_penalty}},
          {"update_penalty", {&p.update_penalty}},
          {"two_pass", {&p.two_pass}},
          {"symmetric_stiffness", {&p.symmetric_stiffness}},
          {"integration_order", {&p.integration_order}},
          {"search_tol", {&p.search_tol}},
          {"search_radius", {&p.search_radius, &p.search_radius_given}},
          {"seg_up", {&p.seg_up}},
          {"node_reloc", {&p.node_reloc}},
          {"minaug", {&p.minaug}},
          {"maxaug", {&p.maxaug}},
          {"flip_primary", {&p.flip_primary}},
          {"flip_secondary", {&p.flip_secondary}},
          {"fric_coeff", {&p.fric_coeff}},
          {"contact_frac", {&p.contact_frac, &p.contact_frac_given}},
          {"offset", {&p.offset}},
          {"tension", {&p.tension}},
          {"shell_bottom_primary", {&p.shell_bottom_primary}},
          {"shell_bottom_secondary", {&p.shell_bottom_secondary}},
          {"knmult", {&p.knmult, &p.knmult_given}},
          {"smooth_aug", {&p.smooth_aug, &p.smooth_aug_given}},
          {"smooth_fls", {&p.smooth_fls, &p.smooth_fls_given}}};
}

void read_slot(const Tag& tag, const Slot& slot) {
  tag.allow_attributes({});
  if (const auto* number = std::get_if<double*>(&slot.value)) {
    **number = tag.number();
  } else if (const auto* integer = std::get_if<int*>(&slot.value)) {
    **integer = tag.integer(std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
  } else {
    *std::get<bool*>(slot.value) = tag.flag();
  }
  if (slot.given) *slot.given = true;
}

/// Which of these words, or of their numbers from 0, a text is.
int choice(const Tag& tag, const std::vector<std::string>& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (tag.text() == words[i] || tag.text() == std::to_string(i)) return static_cast<int>(i);
  }
  tag.fail("allowed: " + listed(words));
}

void read_ambient_concentration(const Tag& tag, const Model& model, ContactDefinition& contact) {
  if (!tag.find_attribute("sol") && model.solutes != 1)
    tag.fail("the attribute sol must say which of the solutes this is for");
  const int solute = tag.find_attribute("sol") ? tag.integer_attribute("sol") : 1;
  if (solute > model.solutes) tag.fail("solute " + std::to_string(solute) + " does not exist");
  if (!contact.ambient_concentration.emplace(solute - 1, read_parameter(tag, model)).second) tag.fail("given twice");
}

void read_parameter_of(const Tag& tag, const Model& model, ContactDefinition& contact) {
  const std::string name = tag.name();
  const auto known = slots(contact.parameters);
  if (name == "laugon") {
    contact.parameters.laugon = choice(tag, {"PENALTY", "AUGLAG", "LAGMULT"});
  } else if (name == "integration") {
    contact.parameters.integration = choice(tag, {"gauss", "segments"});
  } else if (name == "effects") {
    contact.parameters.effects = tag.text();
  } else if (name == "extrapolation") {
    if (tag.flag()) tag.fail("only febio4 can start a step at the extrapolated state; allowed here: 0");
  } else if (name == "ambient_pressure") {
    contact.ambient_pressure = read_parameter(tag, model);
  } else if (name == "ambient_concentration") {
    read_ambient_concentration(tag, model, contact);
  } else if (const auto slot = known.find(name); slot != known.end()) {
    read_slot(tag, slot->second);
  } else {
    tag.fail("this parameter is not supported");
  }
}

void check_surfaces(const Tag& tag, const Model& model, const ContactDefinition& contact) {
  std::set<std::pair<int, std::vector<int>>> faces;
  for (const std::string& name : contact.surfaces) {
    for (const SurfaceFacet& facet : model.mesh.surfaces.at(name)) {
      std::vector<int> nodes(facet.facet.nodes.begin(), facet.facet.nodes.begin() + 4);
      std::sort(nodes.begin(), nodes.end());
      if (!faces.emplace(facet.element, nodes).second)
        tag.fail("the surfaces share facets; a surface cannot be in contact with itself");
    }
  }
}

}  // namespace

void read_contacts(const Tag& section, Model& model) {
  section.allow_children({"contact"});
  for (const Tag& tag : section.children()) {
    tag.allow_attributes({"name", "type", "surface_pair"});
    if (tag.attribute("type") != "sliding-mixture") {
      tag.fail("the type \"" + tag.attribute("type") + R"(" is not supported; allowed: "sliding-mixture")");
    }
    ContactDefinition contact;
    contact.surfaces = named(tag, "surface_pair", model.mesh.pairs);
    contact.name = tag.find_attribute("name").value_or(tag.attribute("surface_pair"));
    for (const Tag& parameter : tag.children()) read_parameter_of(parameter, model, contact);
    const std::vector<std::string> wrong = complaints(contact.parameters);
    if (!wrong.empty()) tag.fail(wrong.front());
    for (const std::string& notice : notices(contact.parameters)) model.notices.push_back(contact.name + ": " + notice);
    check_surfaces(tag, model, contact);
    model.contacts.push_back(std::move(contact));
  }
}

}  // namespace standalone
