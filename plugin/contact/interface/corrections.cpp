#include "interface/corrections.h"

namespace mixture_contact {

bool serves_again(const ContactInterface& contact, const PerSide<SurfaceFields>& fields) {
  bool any_correctable = false;
  for_each_correctable(contact, [&](Side, const HeldLinearisation&) { any_correctable = true; });
  if (!any_correctable) return contact.is_solution(fields);
  if (!faces_as_held(contact)) return false;
  const TaskClock timed = contact.measurements().clock(Task::augmentation);
  bool all = true;
  for_each_moving(contact, [&](Side side, MovingGeometry& moving) {
    const FacingFields seen = seen_from(side, fields);
    const HeldLinearisation& held = moving.held();
    all = all && (held.is_correctable() ? held.serves(seen) : moving.is_solution(seen));
  });
  return all;
}

bool correct(const ContactInterface& contact, const PerSide<SurfaceFields>& fields) {
  const TaskClock timed = contact.measurements().clock(Task::stiffness);
  bool changed = false;
  for_each_moving(contact, [&](Side side, MovingGeometry& moving) {
    changed = moving.held().correct(seen_from(side, fields)) || changed;
  });
  return changed;
}

bool residual_change(const ContactInterface& contact, const PerSide<SurfaceFields>& fields, double dt,
                     const ContactInterface::AddResidual& add) {
  TaskClock timed = contact.measurements().clock(Task::residual);
  bool is_known = true;
  for_each_moving(contact, [&](Side side, MovingGeometry& moving) {
    const auto add_part = [&](const Patch& patch, const VectorXd& values) {
      timed.in_host([&] { add({side, patch}, values); });
    };
    is_known = is_known && moving.held().residual_change(seen_from(side, fields), dt, add_part);
  });
  return is_known;
}

void has_matrix(const ContactInterface& contact, const PerSide<bool>& has_loads) {
  for_each_moving(contact, [&](Side side, MovingGeometry& moving) { moving.held().has_matrix(has_loads[side]); });
}

}  // namespace mixture_contact
