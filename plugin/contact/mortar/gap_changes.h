/// How the gaps at nodes change as the surfaces move.
#pragma once

#include "mortar/mortar_space.h"

namespace mixture_contact {

/// The changes of averaged gaps of these nodes by displacements of both surfaces [mm], to first order in how far the
/// surfaces move apart along the normals, points and normals left as they are; zero at all other nodes.
VectorXd gap_changes(const MortarSpace& space, const NodeFlags& nodes, const FacingPositions& displacements);

}  // namespace mixture_contact
