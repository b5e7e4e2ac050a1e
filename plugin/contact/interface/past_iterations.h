/// Data of past iterations and steps.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// Discards the data of past iterations and steps, such that later iterations depend on the state only. A continued run
/// then gives the same results.
void forget_past(ContactInterface& contact);

}  // namespace mixture_contact
