/// The output of a tie whose broken nodes are in sliding contact.
#pragma once

#include "interface/output.h"

namespace mixture_contact {

/// The output of a tie and of the sliding contact of its broken nodes as that of one contact: sums, and at nodes means
/// over the areas of both. Both exchange the same fields.
InterfaceOutput together(InterfaceOutput tie, const InterfaceOutput& sliding);

}  // namespace mixture_contact
