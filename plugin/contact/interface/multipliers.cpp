#include "interface/multipliers.h"

namespace mixture_contact {

MultiplierLayout multiplier_layout(const ContactInterface& contact) {
  const ContactPass& pass = contact.pass(0);
  return pass.space().has_unknown_multipliers() ? multiplier_layout(pass.laws()) : MultiplierLayout(0, {});
}

VectorXd unknown_multipliers(const ContactInterface& contact) { return scaled_multipliers(contact.pass(0).laws()); }

void set_unknown_multipliers(ContactInterface& contact, const VectorXd& mu) {
  set_scaled_multipliers(contact.pass(0).laws(), mu);
}

}  // namespace mixture_contact
