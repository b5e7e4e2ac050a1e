/// The data that iterations and steps leave for later ones.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// Drops this data, so that later iterations depend on the state alone, for continued runs.
void forget_past(ContactInterface& contact);

}  // namespace mixture_contact
