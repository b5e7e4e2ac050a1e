#include "interface/held_loads.h"

namespace mixture_contact {

void hold_loads(ContactInterface& contact, const PerSide<SurfaceFields>& fields) {
  const TaskClock timed = contact.measurements().clock(Task::residual);
  for (std::size_t pass = 0; pass < contact.passes(); ++pass)
    contact.pass(pass).hold_loads(seen_from(both_sides.at(pass), fields));
}

}  // namespace mixture_contact
