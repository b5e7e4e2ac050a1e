/// Changes of nodal gaps by displacements of the surfaces.
#pragma once

#include "mortar/mortar_space.h"

namespace mixture_contact {

/// Changes of the average gaps of the given nodes by displacements of both surfaces [mm], to first order. Only the
/// displacements along the normals count; integration points and normals stay fixed. Zero at all other nodes.
VectorXd gap_changes(const MortarSpace& space, const NodeFlags& nodes, const FacingPositions& displacements);

}  // namespace mixture_contact
