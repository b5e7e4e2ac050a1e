#include "interface/past_iterations.h"

namespace mixture_contact {

void forget_past(ContactInterface& contact) {
  for (std::size_t pass = 0; pass < contact.passes(); ++pass) contact.pass(pass).geometry().forget_past();
}

void forget_motion(ContactInterface& contact) {
  for (std::size_t pass = 0; pass < contact.passes(); ++pass) contact.pass(pass).laws().multipliers.forget_motion();
}

}  // namespace mixture_contact
