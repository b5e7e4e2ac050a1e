/// The output of a tie whose broken nodes are in sliding contact.
#pragma once

#include "interface/output.h"

namespace mixture_contact {

/// Combines the output of a tie with that of the sliding contact of its broken nodes. Sums are added; nodal values are
/// means weighted with the areas of both. Both have to exchange the same fields.
InterfaceOutput together(InterfaceOutput tie, const InterfaceOutput& sliding);

}  // namespace mixture_contact
