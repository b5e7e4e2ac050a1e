/// The overlap of the surfaces of a contact under load.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// The largest overlap of the nodes in contact.
struct Overlap {
  double depth = 0;  ///< largest overlap by the average gaps [mm]
  double share = 0;  ///< largest overlap, relative to the longest edge of the facets around its node [-]
};

/// The overlap at a state, for whose positions project() has been called.
Overlap largest_overlap(const ContactInterface& contact, const PerSide<SurfaceFields>& fields);

}  // namespace mixture_contact
