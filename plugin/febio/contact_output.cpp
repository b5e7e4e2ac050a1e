#include "contact_output.h"

#include "host/facet_material.h"
#include "host/timings_table.h"
#include "host/warnings.h"

using namespace mixture_contact;

void ContactOutput::store() {
  const ContactInterface& core = contact_.core();
  const TaskClock timed = core.measurements().clock(Task::output);
  const std::vector<int> exchanged = exchanged_solutes(core.effects());
  const InterfaceOutput out = output(core, contact_.fields());
  Balance total = out.balance;
  contact_.surfaces()[Side::primary].store_output(out.nodes[Side::primary], total, exchanged);
  total.force = -total.force;
  total.friction = -total.friction;
  total.flow = -total.flow;
  contact_.surfaces()[Side::secondary].store_output(out.nodes[Side::secondary], total, exchanged);
  warn_of_overlap();
}

void ContactOutput::warn_of_overlap() {
  const UndetectedPenetration& overlap = contact_.core().undetected_penetration();
  if (has_warned_ || overlap.nodes == 0) return;
  has_warned_ = true;
  const PerSide<std::string> names = contact_.surfaces().names();
  contact_.log().warning(overlap_warning(contact_.name(), names[Side::primary], names[Side::secondary], overlap));
}

void ContactOutput::log_timings() const {
  contact_.log().line("");
  for (const std::string& line : timings_table(contact_.name(), contact_.core(), run_.peek()))
    contact_.log().line(line);
}
