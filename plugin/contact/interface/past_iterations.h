/// The data that iterations and steps leave for later ones.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// Forgets it, so that iterations to come depend on the state alone: where they may be those of another run.
void forget_past(ContactInterface& contact);

}  // namespace mixture_contact
