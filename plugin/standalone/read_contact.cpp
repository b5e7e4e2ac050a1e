#include "sections.h"

#include <set>

namespace standalone {
namespace {

/// Takes a parameter, and the flag that tells that it is given.
template <class T>
Child given(const char* name, T& value, bool& flag) {
  return maybe(name, [&value, &flag](const Tag& tag) {
    into(value)(tag);
    flag = true;
  });
}

/// Takes one of some words, or its number, all of which follow.
Read choice(int& value, const Names& words) {
  return [&value, words](const Tag& tag) { value = static_cast<int>(tag.one_of(words) % (words.size() / 2)); };
}

std::vector<Child> table_of(ContactParameters& p) {
  return {maybe("effects", into(p.effects)),
          maybe("laugon", choice(p.laugon, {"PENALTY", "AUGLAG", "LAGMULT", "0", "1", "2"})),
          maybe("integration", choice(p.integration, {"gauss", "segments", "0", "1"})),
          maybe("tolerance", into(p.tolerance)),
          given("traction_tolerance", p.traction_tolerance, p.traction_tolerance_given),
          given("solvent_tolerance", p.solvent_tolerance, p.solvent_tolerance_given),
          given("solute_tolerance", p.solute_tolerance, p.solute_tolerance_given),
          maybe("gaptol", into(p.gaptol)),
          maybe("ptol", into(p.ptol)),
          maybe("ctol", into(p.ctol)),
          given("penalty", p.penalty, p.penalty_given),
          given("pressure_penalty", p.pressure_penalty, p.pressure_penalty_given),
          given("concentration_penalty", p.concentration_penalty, p.concentration_penalty_given),
          maybe("auto_penalty", into(p.auto_penalty)),
          maybe("update_penalty", into(p.update_penalty)),
          maybe("two_pass", into(p.two_pass)),
          maybe("symmetric_stiffness", into(p.symmetric_stiffness)),
          maybe("integration_order", into(p.integration_order)),
          maybe("search_tol", into(p.search_tol)),
          given("search_radius", p.search_radius, p.search_radius_given),
          maybe("seg_up", into(p.seg_up)),
          maybe("extrapolation", must_be({"0"})),  // only febio4 can start a step at the extrapolated state
          maybe("node_reloc", into(p.node_reloc)),
          maybe("minaug", into(p.minaug)),
          maybe("maxaug", into(p.maxaug)),
          maybe("flip_primary", into(p.flip_primary)),
          maybe("flip_secondary", into(p.flip_secondary)),
          maybe("fric_coeff", into(p.fric_coeff)),
          given("contact_frac", p.contact_frac, p.contact_frac_given),
          maybe("offset", into(p.offset)),
          maybe("tension", into(p.tension)),
          maybe("shell_bottom_primary", into(p.shell_bottom_primary)),
          maybe("shell_bottom_secondary", into(p.shell_bottom_secondary)),
          given("knmult", p.knmult, p.knmult_given),
          given("smooth_aug", p.smooth_aug, p.smooth_aug_given),
          given("smooth_fls", p.smooth_fls, p.smooth_fls_given)};
}

void read_ambient_concentration(const Tag& tag, const Model& model, ContactDefinition& contact) {
  tag.read({"lc", "sol"});
  if (!tag.find_attribute("sol") && model.solutes.size() != 1)
    tag.fail("the attribute sol must say which of the solutes this is for");
  const int solute = tag.find_attribute("sol") ? tag.integer_attribute("sol") : 1;
  if (solute > static_cast<int>(model.solutes.size())) tag.fail("solute " + std::to_string(solute) + " does not exist");
  const Parameter value{tag.number(), read_curve(tag, model)};
  if (!contact.ambient_concentration.emplace(solute - 1, value).second) tag.fail("given twice");
}

void check_surfaces(const Tag& tag, const Model& model, const ContactDefinition& contact) {
  std::set<std::pair<int, int>> faces;
  for (const std::string& name : contact.surfaces) {
    for (const SurfaceFacet& facet : model.mesh.surfaces.at(name)) {
      if (!faces.emplace(facet.element, facet.face).second)
        tag.fail("the surfaces share facets; a surface cannot be in contact with itself");
    }
  }
}

void read_contact(const Tag& tag, Model& model) {
  tag.attribute("type", {"sliding-mixture"});
  ContactDefinition contact;
  contact.surfaces = named(tag, "surface_pair", model.mesh.pairs);
  contact.name = tag.find_attribute("name").value_or(tag.attribute("surface_pair"));
  std::vector<Child> table = table_of(contact.parameters);
  table.push_back(maybe("ambient_pressure", into(contact.ambient_pressure, model)));
  table.push_back(
      each("ambient_concentration", [&](const Tag& bath) { read_ambient_concentration(bath, model, contact); }));
  tag.read({"name", "type", "surface_pair"}, table);
  const std::vector<std::string> wrong = complaints(contact.parameters);
  if (!wrong.empty()) tag.fail(wrong.front());
  for (const std::string& notice : notices(contact.parameters)) model.notices.push_back(contact.name + ": " + notice);
  check_surfaces(tag, model, contact);
  model.contacts.push_back(std::move(contact));
}

}  // namespace

void read_contacts(const Tag& section, Model& model) {
  section.read({}, {each("contact", [&](const Tag& tag) { read_contact(tag, model); })});
}

}  // namespace standalone
