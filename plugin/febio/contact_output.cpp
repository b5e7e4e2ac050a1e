#include "contact_output.h"

#include "host/facet_material.h"
#include "host/timings_table.h"
#include "host/warnings.h"

using namespace mixture_contact;

void ContactOutput::store(const BoundContact& contact) {
  const ContactInterface& core = contact.core();
  const TaskClock timed = core.measurements().clock(Task::output);
  const std::vector<int> exchanged = exchanged_solutes(core.effects());
  const InterfaceOutput out = output(core, contact.fields());
  Balance total = out.balance;
  contact.surfaces()[Side::primary].store_output(out.nodes[Side::primary], total, exchanged);
  total.force = -total.force;
  total.friction = -total.friction;
  total.flow = -total.flow;
  contact.surfaces()[Side::secondary].store_output(out.nodes[Side::secondary], total, exchanged);
  warn_of_overlap(contact);
}

void ContactOutput::warn_of_overlap(const BoundContact& contact) {
  const UndetectedPenetration& overlap = contact.core().undetected_penetration();
  if (has_warned_ || overlap.nodes == 0) return;
  has_warned_ = true;
  const PerSide<std::string> names = contact.surfaces().names();
  contact.log().warning(overlap_warning(contact.name(), names[Side::primary], names[Side::secondary], overlap));
}

void ContactOutput::log_timings(const BoundContact& contact) const {
  contact.log().line("");
  for (const std::string& line : timings_table(contact.name(), contact.core(), run_.peek())) contact.log().line(line);
}
