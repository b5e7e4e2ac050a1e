#include "contact_output.h"

#include "host/facet_material.h"
#include "host/timings_table.h"
#include "host/warnings.h"

using namespace mixture_contact;

void ContactOutput::store(const BoundContact& contact) {
  const ContactInterface& core = contact.core();
  const TaskClock timed = core.measurements().clock(Task::output);
  contact.surfaces().store_output(output(core, contact.fields()), core.effects());
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
