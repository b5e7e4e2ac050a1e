#include "interface/past_iterations.h"

namespace mixture_contact {

void forget_past(ContactInterface& contact) {
  for (std::size_t pass = 0; pass < contact.passes(); ++pass) contact.pass(pass).geometry().forget_past();
}

}  // namespace mixture_contact
