/// The nodes over which a pass integrates.
#pragma once

#include "conditions/nodal_laws.h"
#include "mortar/linearisation.h"

namespace mixture_contact {

/// The averages around the nodes of a pass, and the laws at these nodes.
struct PassNodes {
  MortarSpace space;
  NodalLaws laws;

  const Effects& effects() const { return space.effects(); }
};

}  // namespace mixture_contact
