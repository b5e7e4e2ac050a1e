/// How far the surfaces of a contact overlap under load.
#pragma once

#include "interface/interface.h"

namespace mixture_contact {

/// The deepest overlap among the nodes in contact.
struct Overlap {
  double depth = 0;  ///< of the averaged gap [mm]
  double share = 0;  ///< over the longest edge of the facets around the node, the largest of all nodes [-]
};

Overlap largest_overlap(const ContactInterface& contact, const PerSide<SurfaceFields>& fields);

}  // namespace mixture_contact
